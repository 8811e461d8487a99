// What a phase is saved as: what its points are, and what accepted steps have left. The rest follows from these.
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
  if (body_.points.has_domains()) archive_number_of_points(state);
  state("grid_moved", grid_moved_);
  for (std::size_t m = 0; m < body_.materials.size(); ++m)
    state(fmt::format("memory_of_material_{}", m), body_.materials[m]->memory());
  if (updated_lagrangian()) archive_points(state);
  archive_conditions(state);
  if (state.restores() && updated_lagrangian()) {
    take_saved_grid();
    resume_phase(t);
    archive_conditions(state);  // what they remember, in place of what a phase begins with
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

// Domains that were halved are more than there were when the body was placed.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::archive_number_of_points(const StateArchive& state) {
  MaterialPoints<Dim>& points = body_.points;
  const std::vector<int> before = points.material_begin;
  state("material_begin", points.material_begin);
  if (points.material_begin.size() != before.size() || points.material_begin.front() != 0 ||
      !std::ranges::is_sorted(points.material_begin))
    throw StateError("'material_begin' is not that of the materials of this scene");
  if (points.material_begin == before) return;
  std::vector<int> number;
  state("number", number);
  if (number.size() != static_cast<std::size_t>(points.material_begin.back()))
    throw StateError("'material_begin' is not that of its points");
  std::vector<int> from;  // any of the same material: what they are is restored with the rest
  for (std::size_t m = 0; m + 1 < before.size(); ++m)
    from.resize(static_cast<std::size_t>(points.material_begin[m + 1]), before[m]);
  take_points(points, from);
  take_materials(from);
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::archive_points(const StateArchive& state) {
  MaterialPoints<Dim>& points = body_.points;
  for (int d = 0; d < Dim; ++d) {
    state(fmt::format("x_{}", d), Vec(points.x[d]));
    state(fmt::format("v_{}", d), Vec(points.v[d]));
  }
  for (std::size_t ij = 0; ij < points.B_apic.size(); ++ij) state(fmt::format("B_{}", ij), Vec(points.B_apic[ij]));
  if (points.has_domains()) {
    for (std::size_t c = 0; c < points.corner.size(); ++c) state(fmt::format("corner_{}", c), Vec(points.corner[c]));
    for (std::size_t d = 0; d < points.half.size(); ++d) {
      state(fmt::format("half_{}", d), Vec(points.half[d]));
      state(fmt::format("rest_{}", d), Vec(points.rest[d]));
    }
  }
  state("volume", Vec(points.volume));
  state("mass", Vec(points.mass));
  state("number", points.number);
  state("cell", points.cell);
  state("cell_begin", points.cell_begin);
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::archive_conditions(const StateArchive& state) {
  for (std::size_t k = 0; k < boundary_.size(); ++k) boundary_[k]->archive(state.part(fmt::format("condition_{}", k)));
  weak_supports_.archive(state.part("weak_supports"));
  load_control_.archive(state.part("load"));
}

// Where the points and the wall that it follows were when the phase began.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_saved_grid() {
  constexpr double furthest = 1000;  // of the grid's own size; a wall that went further is none that a run could follow
  double size = 0;
  for (std::size_t d = 0; d < Dim; ++d) size = std::max(size, scene_.grid.max[d] - scene_.grid.min[d]);
  if (!(std::abs(grid_moved_) <= furthest * size)) throw StateError("its grid has gone too far");
  grid_ = grid_at<Dim>(scene_, grid_moved_);
  long cells = 1;
  for (const Axis& axis : grid_.axes) cells *= axis.cells();
  if (const std::string fault = disorder_of(body_.points, cells, points()); !fault.empty()) throw StateError(fault);
}

// The phase that began at t, with the points as they were then.
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
