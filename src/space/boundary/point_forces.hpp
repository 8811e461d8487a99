// Forces at points of the body: F_i = N_i(x) P(t).
#pragma once

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "space/boundary/boundary_condition.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PointForces final : public BoundaryCondition<B, K> {
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;
  using typename BoundaryCondition<B, K>::Parts;

 public:
  explicit PointForces(const Scene& scene) : scene_(scene) {}

  void begin_phase(const Parts& phase, Vec F) override {
    varying_.clear();
    for (std::size_t f = 0; f < scene_.forces.size(); ++f) {
      const auto& force = scene_.forces[f];
      for (int i = 0; i < dim; ++i) {
        const Expression& value = force.value[static_cast<std::size_t>(i)];
        Varying load{&value, weights_at(force.at, i, phase, fmt::format("force[{}].at", f))};
        if (value.uses('t')) {
          varying_.push_back(std::move(load));
        } else {
          add(load, 0, F);
        }
      }
    }
  }
  void add_load(const Parts&, double t, Vec F) const override {
    for (const Varying& load : varying_) add(load, t, F);
  }

 private:
  struct Varying {
    const Expression* value;
    std::vector<std::pair<int, double>> weights;  // (free degree of freedom, N_i)
  };

  static void add(const Varying& load, double t, Vec F) {
    const double force = (*load.value)({}, t);
    for (const auto& [dof, weight] : load.weights) F[static_cast<std::size_t>(dof)] += weight * force;
  }

  // N_i of the free degrees of freedom at a point.
  std::vector<std::pair<int, double>> weights_at(const std::vector<double>& at, int component, const Parts& phase,
                                                 const std::string& key) const {
    Point<dim> x;
    std::copy_n(at.begin(), dim, x.begin());
    const auto cell = phase.grid.host_of(x);
    const auto values = Basis::evaluate(phase.grid, cell, x);
    const auto offset = Basis::offsets(phase.grid);
    std::vector<std::pair<int, double>> weights;
    for (int a = 0; a < Basis::per_cell; ++a) {
      const int unknown = dim * (Basis::first(phase.grid, cell) + offset[a]) + component;
      const int dof = phase.dofs.number[static_cast<std::size_t>(unknown)];
      if (dof < 0 && std::abs(values.N[a]) > 1e-12)
        throw_scene_error(scene_, key, "there is no material at this place");
      if (phase.dofs.is_free(dof) && values.N[a] != 0) weights.emplace_back(dof, values.N[a]);
    }
    return weights;
  }

  const Scene& scene_;
  std::vector<Varying> varying_;  // of the present phase
};

}  // namespace stillpoint
