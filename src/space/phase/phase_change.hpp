// The beginning and the end of a phase.
#pragma once

#include <array>
#include <cstdlib>

#include "space/phase/grid_faces.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::progress(double t, ConstVec u) {
  if (!updated_lagrangian()) return 0;
  if (problem_.phase.max_motion == 0) return 1;
  if (conditions_.ask_for_next_phase(u)) return 1;
  double share = 0;
  if (problem_.phase.ends_by_motion()) {
    const bool committed = history_dependent_ && t == committed_t_;
    share = (committed ? committed_motion_ : largest_motion(u)) / problem_.phase.max_motion;
  }
  constexpr long between_looks = 8;  // the strain costs a pass over the points, and is checked only every so many calls
  if (problem_.phase.max_strain && ++looks_ % between_looks == 0) {
    spread(t, u, grid_u_);
    share = std::max(share, largest_strain(grid_u_.data()) / *problem_.phase.max_strain);
  }
  return share;
}

// Whether a trial is within the phase: a step past 3/2 of the motion that ends it is too long for the frozen weights.
template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::is_within_phase(double motion, const double* grid_u) const {
  constexpr double most = 1.5, of_remapping_every_step = 0.5;
  if (problem_.phase.ends_by_motion()) {
    const double allowed = problem_.phase.max_motion > 0 ? most * problem_.phase.max_motion : of_remapping_every_step;
    if (!(motion <= allowed)) return false;
  }
  return !problem_.phase.max_strain || largest_strain(grid_u) <= most * *problem_.phase.max_strain;
}

template <AxisBasis B, Kinematics K>
std::vector<double> MaterialPointPhase<B, K>::begin_next(double t, ConstVec u, ConstVec v) {
  if (start_velocity_.size() != grid_u_.size())
    throw std::logic_error("no phase ends in a scene of a single one, nor before initial_velocity()");
  const std::vector<WallReaction> walls = wall_reactions(t);
  const auto followed = std::ranges::find(walls, problem_.grid.follow, &WallReaction::name);
  const double grid_moves_to = followed == walls.end() ? 0 : followed->displacement;
  Grid<Dim> next_grid = grid_at<Dim>(problem_, grid_moves_to);
  spread(t, u, grid_u_);
  const std::vector<double> grid_v = nodal_velocity(t, v);
  const GridFaces<Dim> faces(problem_, next_grid, conditions_.act_on_axis());
  const bool some_past_a_face = move_points(next_grid, faces, grid_v);
  motion_since_deformation_ += largest_motion(u);
  end_phase(grid_v);
  if (some_past_a_face) faces.put_back(body_.points);
  ++phase_;
  grid_moved_ = grid_moves_to;
  grid_ = std::move(next_grid);
  if constexpr (B::window > 1) {
    halve_domains();
    order_.sort(body_.points, grid_);
  } else {
    order_.sort_by_cells(body_.points, grid_);
  }
  if (!spare_) make_trial();  // the trials of the phase are dead, and their arrays are free
  for (std::size_t m = 0; m < body_.materials.size(); ++m) {
    body_.materials[m]->reorder(order_.order(), spare_->history[m]);
  }
  begin_phase(t);
  return velocity_from_points(t);
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::begin_phase(double t) {
  place_functions(t);
  weigh_motion();
  take_deformation_from_positions();
  make_forces(t);
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::place_functions(double t) {
  make_weights();
  std::vector<char> reached = active_functions();
  held_ = take_hold(t, reached);
  untouched_ = untouched_functions();
  if (dofs_ && reached == reached_ && held_.prescribed() == dofs_->prescribed) return;
  dofs_.emplace(reached, Dim, held_.prescribed(), extension_);
  reached_ = std::move(reached);
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::make_weights() {
  totals_.begin(grid_, body_.points, weights_, wave_moduli());
  nodal_force_.rebuild(body_.points, weights_, static_cast<std::size_t>(Basis::count(grid_)));
  totals_.sum(nodal_force_.corner_sum());
}

template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::make_forces(double t) {
  const std::size_t unknowns = Dim * static_cast<std::size_t>(Basis::count(grid_));
  grid_u_.assign(unknowns, 0);
  grid_du_.assign(unknowns, 0);
  committed_u_.assign(unknowns, 0);
  spread_others(t, committed_u_);
  committed_t_ = t;
  committed_motion_ = 0;
  begin_means();
  take_elastic_moments();
  make_mass();
  constant_force_.assign(size(), 0);
  conditions_.begin_phase(
      parts(), [this] { return bound_of_functions(); }, constant_force_);
}

template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::follows_positions() {
  return updated_lagrangian() && problem_.phase.deformation == DeformationRule::positions &&
         DeformationFromPositions<B, K>::applies(body_);
}

// Weighs the unknowns by the motion of points that they cause: a function that hardly reaches a point moves none.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::weigh_motion() {
  std::array<double, Dim> per_length;
  for (std::size_t d = 0; d < Dim; ++d) per_length[d] = 1 / problem_.grid.cell_length(d);
  motion_weight_.resize(size());
  for_each_index(size(), [per_length, weight = motion_weight_.data(), unknown = dofs_->free.data()](std::size_t k) {
    weight[k] = per_length[static_cast<std::size_t>(unknown[k] % Dim)];
  });
  if (!follows_positions()) return;
  const std::vector<double> share =
      DeformationFromPositions<B, K>::share_of_motion(body_, weights_, static_cast<std::size_t>(Basis::count(grid_)));
  for (std::size_t k = 0; k < size(); ++k) motion_weight_[k] *= share[static_cast<std::size_t>(dofs_->free[k] / Dim)];
}

// Takes the deformation from the positions, but not after every phase if phases are short: the part of the deformation
// that the grid does not feel grows with the motion of the points.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::take_deformation_from_positions() {
  constexpr double cells_between = 0.1;
  if (!follows_positions()) return;
  if (phase_ == 0) return deformation_.begin(body_, weights_, held_, static_cast<std::size_t>(Basis::count(grid_)));
  if (motion_since_deformation_ < cells_between) return;
  motion_since_deformation_ = 0;
  deformation_.apply(grid_, body_, weights_, nodal_force_.corner_sum(), held_, origin_);
}

template <AxisBasis B, Kinematics K>
std::vector<char> MaterialPointPhase<B, K>::active_functions() const {
  std::vector<char> reached(static_cast<std::size_t>(Basis::count(grid_)));
  for (std::size_t f = 0; f < reached.size(); ++f) reached[f] = static_cast<char>(totals_.reaches(f));
  return reached;
}

// Computes the positions to which grid_u_ and grid_v take the points, before anything changes: a run that ends here
// still has its state. Throws PointLost if one is outside the next grid. Returns whether one has to be put back onto a
// face.
template <AxisBasis B, Kinematics K>
bool MaterialPointPhase<B, K>::move_points(const Grid<Dim>& next_grid, const GridFaces<Dim>& faces,
                                           const std::vector<double>& grid_v) {
  const std::size_t none = body_.points.cells();
  std::size_t first_outside = none;  // the first cell with a point past a face
  const NextCells<Dim> next_cells(next_grid);
  order_.cells().resize(body_.points.size());
  const PointMotion<B, K>& motion = transfer_.motion();
  transfer_.move(body_.points, weights_, nodal_force_.corner_sum(), inertia_.mass(), grid_u_, grid_v, start_velocity_,
                 [&](std::size_t k) {
                   if (next_cells.find(body_.points, k, weights_.cell_at(k), motion.x, order_.cells())) return;
#pragma omp critical(stillpoint_lost_point)
                   first_outside = std::min(first_outside, k);
                 });
  for (std::size_t k = first_outside; k < none; ++k) {
    for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
      for (int d = 0; d < Dim; ++d) {
        const Axis& axis = next_grid.axes[d];
        const double x = motion.x[d][p];
        if (faces.keeps(d, x)) continue;
        throw PointLost(fmt::format(
            "{} left the grid at {} = {:.6g}, outside {:.6g} to {:.6g}; expected a larger grid, a support or a wall",
            to_string(account().place(k, p)), "xyz"[d], x, axis.min(), axis.max()));
      }
    }
  }
  return first_outside < none;
}

// Updates the points: x_p += Σ N_ip u_i, V_p *= det f_p, and velocities by the scene's transfer.
template <AxisBasis B, Kinematics K>
void MaterialPointPhase<B, K>::end_phase(const std::vector<double>& grid_v) {
  transfer_.take_velocity(grid_, body_.points, weights_, inertia_.mass(), grid_u_, grid_v, start_velocity_,
                          impulse(grid_v));
  keep_spin(grid_v);
  take_means(grid_u_.data());
  nodal_force_.visit(grid_u_.data(), [&](std::size_t m, Block& block) {
    if (!body_.materials[m]->info().finite_strain) return;
    average_dilatation(m, block);
    body_.materials[m]->end_phase(block);
    double* V = body_.points.volume.data() + block.first;
    for (std::size_t q = 0; q < block.count; ++q) V[q] *= determinant<K>(plus_identity<K>(block.H_at(q)));
  });
  if constexpr (B::window > 1) {
    for_each_block(body_.points.cells(), [&](std::size_t k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) move_corners(k, p);
    });
  }
  body_.points.x.swap(transfer_.motion().x);
  conditions_.end_phase(grid_u_.data());
}

// The largest |u_i| over a cell's width; no point moves further than the nodes around it if N_i ≥ 0 and Σ N_i = 1.
template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::largest_motion(ConstVec u) const {
  return reduce(
      u.size(), 0.0,
      [u = u.data(), weight = motion_weight_.data()](std::size_t k) { return std::abs(u[k]) * weight[k]; },
      [](double a, double b) { return a > b ? a : b; });
}

// Sets the grid's displacements and returns the largest motion, if it ends the phase, in one pass over the unknowns.
template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::spread_and_measure(double t, ConstVec u, std::vector<double>& grid) const {
  if (!problem_.phase.ends_by_motion()) {
    spread(t, u, grid);
    return 0;
  }
  const auto spread_one = [u = u.data(), to = grid.data(), number = dofs_->free.data(),
                           weight = motion_weight_.data()](std::size_t k) {
    to[number[k]] = u[k];
    return std::abs(u[k]) * weight[k];
  };
  const double motion = reduce(u.size(), 0.0, spread_one, [](double a, double b) { return a > b ? a : b; });
  spread_others(t, grid);
  return motion;
}

template <AxisBasis B, Kinematics K>
double MaterialPointPhase<B, K>::largest_strain(const double* grid_u) const {
  double largest = 0;
  nodal_force_.visit(grid_u, [&](std::size_t, const Block& block) {
    double of_block = 0;
    for (const auto& row : block.H) {
      for (std::size_t q = 0; q < block.count; ++q) of_block = std::max(of_block, std::abs(row[q]));
    }
#pragma omp critical(stillpoint_largest_strain)
    largest = std::max(largest, of_block);
  });
  return largest;
}

}  // namespace stillpoint
