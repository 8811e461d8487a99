// The external forces of a phase: point forces, tractions, body force.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "space/boundary/nodal_loads.hpp"
#include "space/boundary/surface_of_body.hpp"
#include "space/kernels/point_weights.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class ExternalLoads {
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;
  using Points = MaterialPoints<dim>;
  using Weights = PointWeights<B, K>;

 public:
  /// All that is given outlives this object.
  ExternalLoads(const Scene& scene, const Grid<dim>& grid)
      : scene_(scene), surface_(make_surface_loads<B, K>(scene, grid)) {}

  /// node_mass: m_i, (functions).
  void begin_phase(const Grid<dim>& grid, const Points& points, const Weights& weights, const DegreesOfFreedom& dofs,
                   const std::vector<double>& node_mass) {
    loads_.emplace(dofs.size());
    for (std::size_t f = 0; f < scene_.forces.size(); ++f) {
      const auto& force = scene_.forces[f];
      for (int i = 0; i < dim; ++i) {
        loads_->add(force.value[static_cast<std::size_t>(i)],
                    weights_at(force.at, i, grid, dofs, fmt::format("force[{}].at", f)));
      }
    }
    if (!surface_.empty() && !surface_.begin_phase(grid, dofs)) {
      throw_scene_error(scene_, "traction", "there is no material at this face");
    }
    if (!varying_body_force()) add_constant_body_force(points, weights, dofs, node_mass);
  }
  /// The phase ends with u, over the grid's functions.
  void end_phase(const double* u) { surface_.end_phase(u); }

  /// F at t; F: (n).
  void evaluate(double t, const Points& points, const Weights& weights, const DegreesOfFreedom& dofs, Vec F) const {
    loads_->evaluate(t, F);
    if (varying_body_force()) add_body_force(t, points, weights, dofs, F);
    surface_.add_dead(t, dofs, F);
  }
  bool follow() const { return surface_.follows(); }
  /// F += what follows the displacements u over the grid's functions; F: (n).
  void add_following(double t, const double* u, const DegreesOfFreedom& dofs, Vec F) const {
    surface_.add_following(t, u, dofs, F);
  }
  /// ∂F/∂u of these, (n × n).
  SparseMatrix following_tangent(double t, const double* u, const DegreesOfFreedom& dofs) const {
    return surface_.following_tangent(t, u, dofs);
  }

 private:
  bool varying_body_force() const {
    return std::ranges::any_of(scene_.body_force, [](const Expression& b) { return b.uses('t'); });
  }

  // F_i = Σ_p N_ip m_p b(x_p); a uniform b acts on the nodes' masses.
  void add_constant_body_force(const Points& points, const Weights& weights, const DegreesOfFreedom& dofs,
                               const std::vector<double>& node_mass) {
    if (scene_.body_force.empty()) return;
    const auto uniform = [](const Expression& b) { return !b.uses('x') && !b.uses('y') && !b.uses('z'); };
    if (B::partition_of_unity && std::ranges::all_of(scene_.body_force, uniform)) {
      std::array<double, dim> b;
      for (std::size_t i = 0; i < dim; ++i) b[i] = scene_.body_force[i]({}, 0);
      for (std::size_t k = 0; k < dofs.size(); ++k) {
        const auto unknown = static_cast<std::size_t>(dofs.free[k]);
        loads_->add_constant(static_cast<int>(k), node_mass[unknown / dim] * b[unknown % dim]);
      }
      return;
    }
    std::vector<double> F(dofs.size(), 0.0);
    add_body_force(0, points, weights, dofs, F);
    for (std::size_t k = 0; k < F.size(); ++k) loads_->add_constant(static_cast<int>(k), F[k]);
  }

  // F_i += Σ_p N_ip m_p b(x_p, t)
  void add_body_force(double t, const Points& points, const Weights& weights, const DegreesOfFreedom& dofs,
                      Vec F) const {
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        for (int i = 0; i < dim; ++i) {
          const double b = scene_.body_force[static_cast<std::size_t>(i)](points.position(p), t);
          weights.add_at_functions(k, p, i, points.mass[p] * b, dofs, F);
        }
      }
    }
  }

  // Weights N_i(x) of the free degrees of freedom at a place.
  NodalLoads::Weights weights_at(const std::vector<double>& at, int component, const Grid<dim>& grid,
                                 const DegreesOfFreedom& dofs, const std::string& key) const {
    Point<dim> x;
    std::copy_n(at.begin(), dim, x.begin());
    const auto cell = grid.cell_of(x);
    const auto values = Basis::evaluate(grid, cell, x);
    const auto offset = Basis::offsets(grid);
    NodalLoads::Weights weights;
    for (int a = 0; a < Basis::per_cell; ++a) {
      const int dof = dofs.number[static_cast<std::size_t>(dim * (Basis::first(grid, cell) + offset[a]) + component)];
      if (dof < 0 && std::abs(values.N[a]) > 1e-12)
        throw_scene_error(scene_, key, "there is no material at this place");
      if (dofs.is_free(dof) && values.N[a] != 0) weights.emplace_back(dof, values.N[a]);
    }
    return weights;
  }

  const Scene& scene_;
  SurfaceLoads<B, K> surface_;
  std::optional<NodalLoads> loads_;  // of the present phase
};

}  // namespace stillpoint
