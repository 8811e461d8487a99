// The saved state of a phase: the state of its points, and what accepted steps have changed. The rest follows from
// these.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <fmt/format.h>

#include "space/phase/material_point_phase.hpp"
#include "space/points/domain_halving.hpp"
#include "space/points/saved_points.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::archive(const StateArchive& state) {
  double t = held_.start();
  state("began_at", t);
  state("phase", phase_);
  if (body_.points.has_domains()) {
    if (const std::vector<int> from = archive_number_of_points(state, body_.points); !from.empty())
      take_materials(from);
  }
  state("grid_moved", grid_moved_);
  for (std::size_t m = 0; m < body_.materials.size(); ++m)
    state(fmt::format("memory_of_material_{}", m), body_.materials[m]->memory());
  if (updated_lagrangian()) archive_points(state, body_.points);
  conditions_.archive(state);
  if (state.restores() && updated_lagrangian()) {
    take_saved_grid();
    resume_phase(t);
    conditions_.archive(state);  // replaces the initial state of the phase by the saved one
  }
  state("committed_u", Vec(committed_u_));
  state("committed_t", committed_t_);
  if (averages_dilatation()) state("committed_effects_of_averages", Vec(committed_averages_));
  state.none_or(grid_u_.size(), "start_velocity", start_velocity_);
  state("looks", looks_);
  state("motion_since_deformation", motion_since_deformation_);
  inertia_.archive(state);
  transfer_.conservation().archive(state);
}

// Restores the grid from the saved displacement of the followed wall, and checks the order of the saved points.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_saved_grid() {
  constexpr double furthest = 1000;  // share of the grid's own size; no run could follow a wall further
  double size = 0;
  for (std::size_t d = 0; d < Dim; ++d) size = std::max(size, problem_.grid.max[d] - problem_.grid.min[d]);
  if (!(std::abs(grid_moved_) <= furthest * size)) throw StateError("its grid has gone too far");
  grid_ = grid_at<Dim>(problem_, grid_moved_);
  long cells = 1;
  for (const Axis& axis : grid_.axes) cells *= axis.cells();
  if (const std::string fault = disorder_of(body_.points, cells, points()); !fault.empty()) throw StateError(fault);
}

// Resumes the phase that began at t, with the points as they were then.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::resume_phase(double t) {
  place_functions(t);
  weigh_motion();
  make_forces(t);
  transfer_.resume(body_.points);
  std::vector<double> v(size());
  begin_motion(t, v);
}

}  // namespace stillpoint
