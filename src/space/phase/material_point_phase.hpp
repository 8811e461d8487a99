// Lagrangian phases for one basis and one kind of kinematics: what they are made of. What they do is in
// phase_forces.hpp, phase_points.hpp and phase_change.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "space/boundary/external_loads.hpp"
#include "space/boundary/prescribed_motion.hpp"
#include "space/boundary/supports_and_walls.hpp"
#include "space/boundary/wall_contact.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/cell_assembly.hpp"
#include "space/kernels/nodal_force.hpp"
#include "space/kernels/nodal_inertia.hpp"
#include "space/kernels/velocity_transfer.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/points/body.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class MaterialPointPhase final : public LagrangianPhase {
  static constexpr int Dim = dimensions(K);
  static constexpr int per_cell = PointWeights<B, K>::per_cell;
  static constexpr int components = stillpoint::gradient_components(K);
  using Basis = TensorBasis<B, Dim>;
  using Block = PointBlock<K>;

 public:
  explicit MaterialPointPhase(const Scene& scene)
      : scene_(scene),
        updated_lagrangian_(scene.phase.max_motion || scene.phase.max_strain),
        grid_(grid_at<Dim>(scene, 0)),
        body_(make_body<K>(scene, grid_, updated_lagrangian_)),
        transfer_(scene.phase),
        inertia_(scene.mass, updated_lagrangian_),
        loads_(scene_, grid_),
        boundary_(scene, time_scale()) {
    for (const auto& material : body_.materials) {
      history_dependent_ = history_dependent_ || material->history_dependent();
      finite_strain_ = finite_strain_ || material->finite_strain();
    }
    initial_mass_ = total_mass();
    origin_ = positions();
    if (scene_.geostatic) set_geostatic_stress();
    if (updated_lagrangian_) set_initial_point_velocity();
    begin_phase(0);
  }

  // --- SemiDiscrete, see phase_forces.hpp ----------------------------------------------------------
  std::size_t size() const override { return dofs_->size(); }
  const Mass& mass() const override { return *mass_; }
  bool history_dependent() const override { return history_dependent_; }

  void external_force(double t, Vec F) const override { loads_.evaluate(t, body_.points, weights_, *dofs_, F); }
  void add_following_force(double t, ConstVec u, Vec F) const override {
    if (!loads_.follow()) return;
    spread(t, u, grid_u_);
    loads_.add_following(t, grid_u_.data(), *dofs_, F);
  }
  SparseMatrix following_tangent_matrix(double t, ConstVec u) const override {
    spread(t, u, grid_u_);
    return loads_.following_tangent(t, grid_u_.data(), *dofs_);
  }

  bool internal_force(double t, ConstVec u, Vec R) const override;
  void tangent(double t, ConstVec u, ConstVec du, Vec dR) const override {
    apply_tangent(Tangent::consistent, t, u, du, dR);
  }
  SparseMatrix tangent_matrix(double t, ConstVec u) const override {
    return assemble_tangent(Tangent::consistent, t, u);
  }
  void elastic_tangent(double t, ConstVec u, ConstVec du, Vec dR) const override {
    apply_tangent(Tangent::elastic, t, u, du, dR);
  }
  SparseMatrix elastic_tangent_matrix(double t, ConstVec u) const override {
    return assemble_tangent(Tangent::elastic, t, u);
  }
  void commit(double t, ConstVec u) override;
  void commit_last() override;
  void add_support_inertia(double t, double c, Vec Q) const override;
  bool has_contact() const override { return !boundary_.walls().empty(); }
  void add_contact_force(double t, const LinearDamping& C, Vec Q) const override {
    for (const WallContact& wall : boundary_.walls()) wall.add_force(t, C, *mass_, Q);
  }
  void hold_contact(Vec Q) const override {
    for (const WallContact& wall : boundary_.walls()) wall.hold(Q);
  }
  bool update_contact(double t, ConstVec u, Vec v) override {
    bool changed = false;
    for (WallContact& wall : boundary_.walls()) changed = wall.update(t, u, v) || changed;
    return changed;
  }

  double reaction_norm() const override;

  // --- LagrangianPhase, see phase_points.hpp -------------------------------------------------------
  int dim() const override { return Dim; }
  int gradient_components() const override { return components; }
  int stress_components() const override { return stillpoint::stress_components(K); }
  std::size_t points() const override { return body_.points.size(); }
  std::vector<double> positions() const override;
  std::vector<double> initial_positions() const override { return origin_; }
  std::vector<double> volumes() const override;
  std::vector<int> materials() const override;
  double total_mass() const override;
  void point_displacement(double t, ConstVec u, Vec out) const override;
  void point_velocity(double t, ConstVec v, Vec out) const override;
  void point_strain(double t, ConstVec u, Vec out) const override;
  void point_stress(double t, ConstVec u, Vec out) const override;
  std::vector<std::string> history_names() const override;
  void point_history(const std::string& name, Vec out) const override;
  std::vector<double> initial_displacement(double t) const override;
  std::vector<double> initial_velocity(double t) override;
  bool updated_lagrangian() const override { return updated_lagrangian_; }

  double phase_progress(double t, ConstVec u) const override;
  std::vector<double> begin_next_phase(double t, ConstVec u, ConstVec v) override;
  TransferErrors transfer_errors() const override {
    return {transfer_.conservation().mass(), transfer_.conservation().momentum(), inertia_.largest_added_mass()};
  }

  std::vector<WallReaction> wall_reactions(double t) const override;
  std::vector<PointArray> point_arrays() const override;
  std::size_t supported_degrees_of_freedom() const override { return dofs_->prescribed.size(); }
  std::vector<int> grid_cells() const override;
  std::size_t occupied_cells() const override {
    return std::set<int>(body_.points.cell.begin(), body_.points.cell.end()).size();
  }
  QuadratureReport quadrature() const override { return body_.quadrature; }
  bool nonlinear() const override { return finite_strain_ || history_dependent_; }
  // With history the elastic part is small, and what it yields only softens.
  bool stiffens() const override { return finite_strain_ && !history_dependent_; }
  double stiffening(double t, ConstVec u) const override;

 private:
  // --- tangents, see phase_forces.hpp --------------------------------------------------------------
  void apply_tangent(Tangent kind, double t, ConstVec u, ConstVec du, Vec dR) const;
  SparseMatrix assemble_tangent(Tangent kind, double t, ConstVec u) const;

  // --- a phase begins and ends, see phase_change.hpp -----------------------------------------------
  void begin_phase(double t);
  std::vector<char> active_functions() const;
  double time_scale() const;

  void make_mass();
  void check_projection() const;

  void set_geostatic_stress();
  void set_initial_point_velocity();
  std::vector<double> velocity_from_points(double t);
  void begin_contact(double t, Vec v) { boundary_.begin_contact(t, *dofs_, v); }

  std::vector<double> nodal_velocity(double t, ConstVec v) const;
  void end_phase(double t, ConstVec u, ConstVec v);
  void check_inside(const Grid<Dim>& next_grid, double t, ConstVec u) const;

  double largest_motion(ConstVec u) const;
  double largest_strain() const;

  // --- grid values --------------------------------------------------------------------------------
  const PointMaterial<K>& material_of(std::size_t k) const {
    return *body_.materials[static_cast<std::size_t>(body_.points.material_of_cell(k))];
  }
  void spread_prescribed(double t, std::vector<double>& grid) const {
    for (std::size_t s = 0; s < dofs_->prescribed.size(); ++s) {
      grid[static_cast<std::size_t>(dofs_->prescribed[s])] = boundary_.displacement_in_phase(s, t);
    }
  }
  // The grid's displacements from the free unknowns and the supports at time t.
  void spread(double t, ConstVec u, std::vector<double>& grid) const {
    for_each_index(u.size(),
                   [u, to = grid.data(), number = dofs_->free.data()](std::size_t k) { to[number[k]] = u[k]; });
    spread_prescribed(t, grid);
  }
  /// visit(occupied cell, point, number of the point)
  template <class Visit>
  void for_points(const Visit& visit) const {
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
        visit(k, p, static_cast<std::size_t>(body_.points.number[p]));
      }
    }
  }

  /// out: what value_at(occupied cell, point) gives, an array, at each point's number.
  template <class ValueAt>
  void write_points(Vec out, const ValueAt& value_at) const {
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto value = value_at(k, p);
      std::copy(value.begin(), value.end(), out.begin() + static_cast<std::ptrdiff_t>(value.size() * number));
    });
  }
  std::vector<double> project(const std::vector<Expression>& field, const std::vector<double>& held) const;
  const Scene scene_;
  bool updated_lagrangian_;
  bool history_dependent_ = false, finite_strain_ = false;
  Grid<Dim> grid_;
  Body<K> body_;
  VelocityTransfer<B, K> transfer_;
  NodalInertia<B, K> inertia_;
  ExternalLoads<B, K> loads_;
  Boundary boundary_;
  PointOrder<Dim> order_;
  std::vector<double> origin_;  // places at the start of the run, in the points' order of then, (P × Dim)
  double initial_mass_ = 0;

  // Of the present phase:
  PointWeights<B, K> weights_;
  std::optional<DegreesOfFreedom> dofs_;
  SplitMatrix consistent_;  // M as assembled, for projections and moving supports; of a single phase only
  std::optional<Mass> mass_;
  std::vector<double> start_velocity_;  // over the grid's functions, (functions × Dim)
  std::vector<double> committed_u_;     // likewise
  double committed_t_ = 0;

  // Work arrays, sized once a phase; evaluations of one phase are not for several threads at once.
  mutable NodalForce<B, K> nodal_force_;
  mutable std::vector<double> grid_u_, grid_work_;  // (functions × Dim)
  mutable double last_t_ = 0;
  mutable double undeformed_bound_ = 0;
  mutable long looks_ = 0;
};

}  // namespace stillpoint
