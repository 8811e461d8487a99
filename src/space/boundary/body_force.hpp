// The body force of a scene: F_i = Σ_p N_ip m_p b(x_p, t).
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <vector>

#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/point_loads.hpp"

namespace stillpoint {

template <int Dim>
class BodyForce final : public BoundaryCondition<Dim> {
  static constexpr std::size_t dim = Dim;
  using typename BoundaryCondition<Dim>::Parts;

 public:
  explicit BodyForce(const Problem& problem) : b_(problem.body_force) {}

  void begin_phase(const Parts& phase, Vec F) override {
    if (varies()) return;
    if (phase.functions.partition_of_unity() &&
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
    add_point_loads(phase, at_points(phase, 0), sum);
    for (std::size_t k = 0; k < F.size(); ++k) F[k] += sum[k];
  }
  std::string_view kind() const override { return "body_force"; }
  bool varies() const override {
    return std::ranges::any_of(b_, [](const Expression& b) { return b.uses('t'); });
  }
  void add_load(const Parts& phase, double t, Vec F) const override {
    if (varies()) add_point_loads(phase, at_points(phase, t), F);
  }
  void add_load_on_supports(const Parts& phase, double t, const double*, Vec F_s) const override {
    add_point_loads_on_supports(phase, at_points(phase, t), F_s);
  }

 private:
  auto at_points(const Parts& phase, double t) const {
    return [this, &points = phase.points, t](std::size_t p, int i) {
      return b_[static_cast<std::size_t>(i)](points.position(p), t);
    };
  }

  const std::vector<Expression>& b_;
};

}  // namespace stillpoint
