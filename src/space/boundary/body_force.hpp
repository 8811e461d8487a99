// The body force of a scene: F_i = Σ_p N_ip m_p b(x_p, t).
#pragma once

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include "space/boundary/boundary_condition.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class BodyForce final : public BoundaryCondition<B, K> {
  static constexpr int dim = dimensions(K);
  using typename BoundaryCondition<B, K>::Parts;

 public:
  explicit BodyForce(const Scene& scene) : b_(scene.body_force) {}

  void begin_phase(const Parts& phase, Vec F) override {
    if (varies()) return;
    if (B::partition_of_unity &&
        std::ranges::none_of(b_, &Expression::uses_position)) {  // it acts on the nodes' masses
      std::array<double, dim> b;
      for (std::size_t i = 0; i < dim; ++i) b[i] = b_[i]({}, 0);
      for (std::size_t k = 0; k < F.size(); ++k) {
        const auto unknown = static_cast<std::size_t>(phase.dofs.free[k]);
        F[k] += phase.node_mass[unknown / dim] * b[unknown % dim];
      }
      return;
    }
    std::vector<double> sum(F.size(), 0.0);
    add_from_points(phase, 0, sum);
    for (std::size_t k = 0; k < F.size(); ++k) F[k] += sum[k];
  }
  bool varies() const override {
    return std::ranges::any_of(b_, [](const Expression& b) { return b.uses('t'); });
  }
  void add_load(const Parts& phase, double t, Vec F) const override {
    if (varies()) add_from_points(phase, t, F);
  }
  void add_load_on_supports(const Parts& phase, double t, const double*, Vec F_s) const override {
    const auto& points = phase.points;
    const std::size_t n = phase.dofs.size();
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (int a = 0; a < phase.weights.per_cell; ++a) {
        for (int i = 0; i < dim; ++i) {
          phase.dofs.for_sources(dim * phase.weights.function(k, a) + i, [&](int, int dof, double share) {
            if (phase.dofs.is_free(dof)) return;
            for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
              const double b = b_[static_cast<std::size_t>(i)](points.position(p), t);
              F_s[static_cast<std::size_t>(dof) - n] += share * points.mass[p] * b * phase.weights.N(k, p)[a];
            }
          });
        }
      }
    }
  }

 private:
  void add_from_points(const Parts& phase, double t, Vec F) const {
    const auto& points = phase.points;
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        for (int i = 0; i < dim; ++i) {
          const double b = b_[static_cast<std::size_t>(i)](points.position(p), t);
          phase.weights.add_at_functions(k, p, i, points.mass[p] * b, phase.dofs, F);
        }
      }
    }
  }

  const std::vector<Expression>& b_;
};

}  // namespace stillpoint
