// The inertia of a phase, and the momentum of the points at its end.
#pragma once

#include <span>

#include "scene/dimensions.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

// The wave modulus λ + 2μ of each material [Pa].
template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::wave_moduli() const {
  std::vector<double> moduli;
  for (const auto& material : body_.materials) moduli.push_back(material->info().wave_modulus);
  return moduli;
}

// The stiffness_bound(), with that of extended functions added to their sources.
template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::bound_of_functions() const {
  if (extension_.empty()) return totals_.bound();
  return stiffness_bound<B, K>(body_.points, weights_, nodal_force_.corner_sum(), wave_moduli(), extension_);
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::make_mass() {
  std::vector<double> m = totals_.mass();
  give_mass_to_sources<B>(grid_, extension_, m);
  inertia_.begin_phase(grid_, std::move(m), bound_of_functions(), untouched_);
  const bool is_consistent = problem_.mass.kind == MassKind::consistent;
  if (is_consistent || (projects() && !updated_lagrangian())) {
    consistent_ = consistent_mass<B, K>(grid_, body_.points, weights_, *dofs_);
    // Initial values are fitted with the consistent mass, whatever the motion has.
    if (!is_consistent && !SparseCholesky(consistent_->free).positive_definite()) {
      throw_scene_error(
          "initial",
          "initial values cannot be fitted: too few material points for the basis; expected more points per cell");
    }
  }
  try {
    if (is_consistent) {
      mass_.emplace(Mass::consistent(consistent_->free));
    } else {
      std::vector<double> diagonal(size());
      for (std::size_t k = 0; k < diagonal.size(); ++k) {
        diagonal[k] = inertia_.inertia()[static_cast<std::size_t>(dofs_->free[k] / Dim)];
      }
      mass_.emplace(Mass::lumped(std::move(diagonal), relative_inertia()));
    }
  } catch (const std::invalid_argument& error) {
    throw_scene_error("mass.kind", error.what());
  }
}

// Whether neither a support nor a wall holds a function in any component, (functions).
template <AxisBasis B, Kinematics K>
std::vector<char> MaterialPointPhase<B, K>::untouched_functions() const {
  std::vector<char> untouched(static_cast<std::size_t>(Basis::count(grid_)), 1);
  for (std::size_t f = 0; f < untouched.size(); ++f) {
    for (int i = 0; i < Dim; ++i) {
      const int unknown = Dim * static_cast<int>(f) + i;
      if (held_.is_prescribed(unknown) || held_.is_guided(unknown)) untouched[f] = 0;
    }
  }
  return untouched;
}

// The inertia added to light functions, at the degrees of freedom.
template <AxisBasis B, Kinematics K>
std::vector<RelativeInertia> MaterialPointPhase<B, K>::relative_inertia() const {
  std::vector<RelativeInertia> terms;
  const auto dof_of = [&](int function, int i) { return dofs_->number[static_cast<std::size_t>(Dim * function + i)]; };
  for (const AddedInertia& added : inertia_.added()) {
    const Extrapolation& from = added.relative_to;
    for (int i = 0; i < Dim; ++i) {
      RelativeInertia term{.dof = dof_of(added.function, i), .inertia = added.inertia, .masters = from.functions};
      if (!dofs_->is_free(term.dof)) continue;
      for (int k = 0; k < from.functions; ++k) {
        term.master[k] = dof_of(from.function[k], i);
        term.weight[k] = from.weight[k];
      }
      terms.push_back(term);
    }
  }
  return terms;
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::velocity_from_points(double t) {
  transfer_.conservation().compare_mass(info_.total_mass, inertia_.mass());
  transfer_.begin_phase(grid_, body_.points, weights_, nodal_force_.corner_sum(), inertia_.mass(), totals_.momentum(),
                        phase_ == 0);
  if (is_free()) transfer_.conservation().compare_with_start(body_.points);
  const std::vector<double> grid_v =
      transfer_.to_grid(grid_, body_.points, weights_, nodal_force_.corner_sum(), inertia_.mass(), totals_.momentum());
  std::vector<double> v(size());
  for_each_index(v.size(), [to = v.data(), from = grid_v.data(), number = dofs_->free.data()](std::size_t k) {
    to[k] = from[number[k]];
  });
  begin_motion(t, v);
  start_velocity_ = nodal_velocity(t, v);
  return v;
}

// The velocities v over the grid's functions.
template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::nodal_velocity(double t, ConstVec v) const {
  std::vector<double> grid_v(grid_u_.size(), 0.0);
  for_each_index(v.size(), [from = v.data(), to = grid_v.data(), number = dofs_->free.data()](std::size_t k) {
    to[number[k]] = from[k];
  });
  for (std::size_t s = 0; s < dofs_->prescribed.size(); ++s) {
    grid_v[static_cast<std::size_t>(dofs_->prescribed[s])] = held_.motion(s).velocity(t);
  }
  dofs_->extend(grid_v.data());
  return grid_v;
}

// Whether no external forces act on the body.
template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::is_free() const {
  return problem_.supports.empty() && problem_.walls.empty() && problem_.forces.empty() && problem_.tractions.empty() &&
         !problem_.has_body_force() && !problem_.load && !conditions_.act_on_axis() &&
         is_undamped(problem_.damping.strategy);
}

// The momentum that the forces of the phase gave to each function, (M (v − v_0))_i [kg m/s], (functions × dim), with
// the inertia of the motion instead of the points' mass. Next to supports and walls the mass counts, since their forces
// are not known apart from those that added inertia takes; with scaling by Gershgorin it always does, as that inertia
// is no mass.
template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::impulse(const std::vector<double>& grid_v) const {
  std::vector<double> gain(grid_v.size());
  for_each_index(gain.size(),
                 [gain = gain.data(), m = inertia_.mass().data(), now = grid_v.data(),
                  before = start_velocity_.data()](std::size_t i) { gain[i] = m[i / Dim] * (now[i] - before[i]); });
  if (!mass_->is_lumped() || problem_.mass.scaling == MassScaling::gershgorin || inertia_.added().empty()) return gain;
  std::vector<double> dv(size()), M_dv(size());
  const auto grid_number = [&](std::size_t k) { return static_cast<std::size_t>(dofs_->free[k]); };
  for (std::size_t k = 0; k < dv.size(); ++k) dv[k] = grid_v[grid_number(k)] - start_velocity_[grid_number(k)];
  mass_->apply(dv, M_dv);
  for (std::size_t k = 0; k < dv.size(); ++k) {
    if (untouched_[grid_number(k) / Dim]) gain[grid_number(k)] = M_dv[k] / problem_.mass.factor;
  }
  return gain;
}

// Transfers the spin of the relative inertia: δ_i has an angular momentum Σ δ_i d_i × ḋ_i, d_i = u_i − Σ_k w_k u_k,
// when the phase ends, which apic's points take over as spin, so that none is lost. Points that store a gradient cannot
// take it.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::keep_spin(const std::vector<double>& grid_v) {
  if constexpr (Dim > 1) {
    if (problem_.phase.transfer != Transfer::apic || inertia_.added().empty()) return;
    if (AffineVelocity<B, K>::carries_gradient) return;
    constexpr std::span<const Turn> about = dimension_info(Dim).turns;
    constexpr std::size_t turns = about.size();
    std::vector<double> spin(turns * inertia_.mass().size());  // δ_i (d_i × ḋ_i)/m_i
    for (const AddedInertia& added : inertia_.added()) {
      const auto i = static_cast<std::size_t>(added.function);
      if (added.relative_to.functions == 0 || !(inertia_.mass()[i] > 0)) continue;
      const auto d = deviation<Dim>(grid_u_, added), d_dot = deviation<Dim>(grid_v, added);
      const double delta = added.inertia / problem_.mass.factor;
      for (std::size_t r = 0; r < turns; ++r) {
        const auto& [axis, from, to] = about[r];
        const double turn = d[from] * d_dot[to] - d[to] * d_dot[from];
        spin[turns * i + r] = delta * turn / inertia_.mass()[i];
      }
    }
    for_each_block(body_.points.cells(), [&](std::size_t k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
        const auto N = weights_.N(k, p);
        for (std::size_t r = 0; r < turns; ++r) {
          double of_point = 0;
          for (int a = 0; a < per_cell; ++a)
            of_point += N[a] * spin[turns * static_cast<std::size_t>(weights_.function(k, a)) + r];
          const auto& [axis, from, to] = about[r];
          body_.points.B_apic[Dim * to + from][p] += of_point / 2;
          body_.points.B_apic[Dim * from + to][p] -= of_point / 2;
        }
      }
    });
  }
}

}  // namespace stillpoint
