// The inertia of a phase: its mass, the projection of initial values by it, and the impulses that it takes up.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/mass.hpp>

#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "linalg/sparse_cholesky.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/point_loads.hpp"
#include "space/kernels/cell_assembly.hpp"
#include "space/kernels/extended_sums.hpp"
#include "space/kernels/nodal_inertia.hpp"
#include "space/phase/phase_frame.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PhaseInertia {
  static constexpr int dim = dimensions(K);

 public:
  /// frame: must outlive this object.
  explicit PhaseInertia(const PhaseFrame<B, K>& frame)
      : frame_(frame), of_functions_(frame.problem.mass, frame.moves_on(), frame.functions) {}

  /// Makes the mass of a phase that begins. Throws SceneError if it is not positive definite.
  void begin_phase() {
    std::vector<double> m = frame_.totals.mass();
    give_mass_to_sources<B>(frame_.grid, frame_.extension, m);
    of_functions_.begin_phase(std::move(m), frame_.bound_of_functions(), frame_.unknowns.untouched());
    const Problem& problem = frame_.problem;
    const bool is_consistent = problem.mass.kind == MassKind::consistent;
    const bool projects = !problem.initial_u.empty() || !problem.initial_v.empty();
    if (is_consistent || (projects && !frame_.moves_on())) {
      consistent_ = consistent_mass_of_points();
      // Initial values are fitted with the consistent mass, whatever the motion has.
      if (!is_consistent && !SparseCholesky(consistent_->free).positive_definite()) {
        throw_scene_error(
            "initial",
            "initial values cannot be fitted: too few material points for the basis; expected more points per cell");
      }
    }
    try {
      mass_.emplace(is_consistent ? Mass::consistent(consistent_->free) : lumped());
    } catch (const std::invalid_argument& error) {
      throw_scene_error("mass.kind", error.what());
    }
  }

  const Mass& mass() const { return *mass_; }
  /// The inertia of the grid's functions, and m_i, (functions) [kg].
  const NodalInertia<dim>& of_functions() const { return of_functions_; }
  const std::vector<double>& node_mass() const { return of_functions_.mass(); }
  /// What the boundary conditions use of the phase.
  PhaseParts<dim> parts() const {
    return {frame_.grid,
            frame_.functions,
            frame_.body.points,
            frame_.weights,
            frame_.corner_sum,
            frame_.held(),
            frame_.dofs(),
            node_mass(),
            *mass_,
            frame_.remembers,
            frame_.is_of_small_strain(),
            frame_.gone};
  }
  void archive(const StateArchive& state) { of_functions_.archive(state); }

  /// Q −= M_fs (a_s + c v_s) of moving supports s, with a consistent mass.
  void add_moving_supports(double t, double c, Vec Q) const {
    if (mass_->is_lumped()) return;
    const HeldUnknowns& held = frame_.held();
    for (std::size_t s = 0; s < held.prescribed().size(); ++s) {
      const PrescribedMotion& motion = held.motion(s);
      if (!motion.moves()) continue;
      const double driven = motion.acceleration(t) + c * motion.velocity(t);
      for (SparseMatrix::InnerIterator m(consistent_->prescribed, static_cast<Eigen::Index>(s)); m; ++m)
        Q[static_cast<std::size_t>(m.row())] -= m.value() * driven;
    }
  }

  /// The projection M_ff u_f = Σ_p m_p N_fp u_0(x_p) − M_fs u_s: the least-squares fit at the material points, whatever
  /// the mass of the motion; 0 if the field is empty. held: u_s, (prescribed unknowns).
  std::vector<double> project(const std::vector<Expression>& field, const std::vector<double>& held) const {
    std::vector<double> u(frame_.size(), 0.0);
    if (field.empty()) return u;
    const MaterialPoints<dim>& points = frame_.body.points;
    add_point_loads(
        parts(), [&](std::size_t p, int i) { return field[static_cast<std::size_t>(i)](points.position(p), 0); }, u);
    std::optional<SplitMatrix> of_points;
    if (!consistent_) of_points = consistent_mass_of_points();
    const SplitMatrix& M = consistent_ ? *consistent_ : *of_points;
    if (!held.empty()) {
      const Eigen::Map<const Eigen::VectorXd> u_s(held.data(), static_cast<Eigen::Index>(held.size()));
      Eigen::Map<Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())) -= M.prescribed * u_s;
    }
    SparseCholesky(M.free).solve(u, u);
    return u;
  }

  /// The momentum that the forces of the phase gave to each function, (M (v − v_0))_i [kg m/s], (functions × dim), with
  /// the inertia of the motion instead of the points' mass. Next to supports and walls the mass counts, since their
  /// forces are not known apart from those that added inertia takes; with scaling by Gershgorin it always does, as that
  /// inertia is no mass.
  std::vector<double> impulse(const std::vector<double>& grid_v, const std::vector<double>& start) const {
    std::vector<double> gain(grid_v.size());
    for_each_index(gain.size(),
                   [gain = gain.data(), m = node_mass().data(), now = grid_v.data(),
                    before = start.data()](std::size_t i) { gain[i] = m[i / dim] * (now[i] - before[i]); });
    const MassSpec& spec = frame_.problem.mass;
    if (!mass_->is_lumped() || spec.scaling == MassScaling::gershgorin || of_functions_.added().empty()) return gain;
    std::vector<double> dv(frame_.size()), M_dv(frame_.size());
    const auto grid_number = [&](std::size_t k) { return static_cast<std::size_t>(frame_.dofs().free[k]); };
    for (std::size_t k = 0; k < dv.size(); ++k) dv[k] = grid_v[grid_number(k)] - start[grid_number(k)];
    mass_->apply(dv, M_dv);
    for (std::size_t k = 0; k < dv.size(); ++k) {
      if (frame_.unknowns.untouched()[grid_number(k) / dim]) gain[grid_number(k)] = M_dv[k] / spec.factor;
    }
    return gain;
  }

 private:
  SplitMatrix consistent_mass_of_points() const {
    return consistent_mass<B, K>(frame_.grid, frame_.body.points, frame_.weights, frame_.corner_sum, frame_.dofs());
  }
  Mass lumped() const {
    std::vector<double> diagonal(frame_.size());
    for (std::size_t k = 0; k < diagonal.size(); ++k)
      diagonal[k] = of_functions_.inertia()[static_cast<std::size_t>(frame_.dofs().free[k] / dim)];
    return Mass::lumped(std::move(diagonal), relative_inertia());
  }
  // The inertia added to light functions, at the degrees of freedom.
  std::vector<RelativeInertia> relative_inertia() const {
    const DegreesOfFreedom& dofs = frame_.dofs();
    std::vector<RelativeInertia> terms;
    const auto dof_of = [&](int function, int i) { return dofs.number[static_cast<std::size_t>(dim * function + i)]; };
    for (const AddedInertia& added : of_functions_.added()) {
      const Extrapolation& from = added.relative_to;
      for (int i = 0; i < dim; ++i) {
        RelativeInertia term{.dof = dof_of(added.function, i), .inertia = added.inertia, .masters = from.functions};
        if (!dofs.is_free(term.dof)) continue;
        for (int k = 0; k < from.functions; ++k) {
          term.master[k] = dof_of(from.function[k], i);
          term.weight[k] = from.weight[k];
        }
        terms.push_back(term);
      }
    }
    return terms;
  }

  const PhaseFrame<B, K>& frame_;
  NodalInertia<dim> of_functions_;
  std::optional<SplitMatrix> consistent_;  // M as assembled, if projections or moving supports need it
  std::optional<Mass> mass_;
};

}  // namespace stillpoint
