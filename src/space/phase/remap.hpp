// From one phase to the next: velocities from the points to the grid and back, the motion of the points, and their new
// order.
#pragma once

#include <stillpoint/damping.hpp>

#include <algorithm>
#include <limits>
#include <mutex>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/dimensions.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/conditions.hpp"
#include "space/boundary/rigid_faces.hpp"
#include "space/kernels/velocity_transfer.hpp"
#include "space/phase/deformation_from_positions.hpp"
#include "space/phase/grid_faces.hpp"
#include "space/phase/internal_force.hpp"
#include "space/phase/phase_frame.hpp"
#include "space/phase/phase_inertia.hpp"
#include "space/points/domain_halving.hpp"
#include "space/points/next_cells.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class Remap {
  static constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  using Block = PointBlock<K>;
  using Basis = TensorBasis<B, dim>;

 public:
  /// The arguments must outlive this object.
  Remap(PhaseFrame<B, K>& frame, InternalForce<B, K>& force, const PhaseInertia<B, K>& inertia,
        Conditions<K>& conditions)
      : frame_(frame),
        force_(force),
        inertia_(inertia),
        conditions_(conditions),
        transfer_(frame.problem.phase, !is_undamped(frame.problem.damping.strategy), frame.ranks) {}

  /// Whether the deformation of the points is taken from their positions.
  bool follows_positions() const {
    return frame_.moves_on() && frame_.problem.phase.deformation == DeformationRule::positions &&
           !frame_.is_of_small_strain() && DeformationFromPositions<B, K>::applies(frame_.body);
  }
  /// Takes the deformation from the positions when a phase begins, but not after every phase if phases are short: the
  /// part of the deformation that the grid does not feel grows with the motion of the points.
  void take_deformation() {
    constexpr double cells_between = 0.1;
    if (!follows_positions()) return;
    if (!deformation_.has_begun())
      return deformation_.begin(frame_.body, frame_.weights, frame_.corner_sum, frame_.held());
    if (motion_since_deformation_ < cells_between) return;
    motion_since_deformation_ = 0;
    deformation_.apply(frame_.grid, frame_.body, frame_.weights, frame_.corner_sum, frame_.held(), frame_.origin);
  }
  /// The velocities with which a phase begins, from those of the points, (n).
  std::vector<double> begin_motion(double t) {
    const std::vector<double>&m = inertia_.node_mass(), &momentum = frame_.totals.momentum();
    transfer_.conservation().compare_mass(frame_.total_mass, m);
    transfer_.begin_phase(frame_.grid, points_, frame_.weights, frame_.corner_sum, m, momentum, frame_.phase == 0);
    if (is_free()) transfer_.conservation().compare_with_start(points_);
    std::vector<double> v = frame_.unknowns.free_values(
        transfer_.to_grid(frame_.grid, points_, frame_.weights, frame_.corner_sum, m, momentum));
    conditions_.begin_motion(inertia_.parts(), t, v);
    start_velocity_ = frame_.unknowns.velocities(t, v);
    return v;
  }
  /// The saved grid of a phase has other numbers than `before`, with which the run has begun; conditions save their
  /// own.
  void take_saved_numbers(const Grid<dim>& before) {
    if (before.box == frame_.grid.box) return;
    deformation_.renumber(NumberedCells<dim>::template now_of<Basis>(before, frame_.grid, frame_.body.fields),
                          frame_.functions_of_grid());
  }
  /// Resumes the motion in a phase that began with these points at t.
  void resume(double t) {
    transfer_.resume(points_);
    std::vector<double> v(frame_.size());
    conditions_.begin_motion(inertia_.parts(), t, v);
  }

  /// Ends the phase at (t, u, v): the points move on, and are sorted in the grid of the next one. motion: of the phase
  /// [cells]. Throws PointLost if a point leaves the grid, and SceneError if a followed wall does so, before anything
  /// has changed.
  void end_phase(double t, ConstVec u, ConstVec v, double motion) {
    if (start_velocity_.empty())
      throw std::logic_error("no phase ends in a scene of a single one, nor before initial_velocity()");
    const std::vector<WallReaction> walls = conditions_.wall_reactions(t);
    const auto followed = std::ranges::find(walls, frame_.problem.grid.follow, &WallReaction::name);
    const double grid_moves_to = followed == walls.end() ? 0 : followed->displacement;
    if (!can_follow(frame_.problem, grid_moves_to))
      throw_scene_error(
          "grid.follow",
          fmt::format("the wall has moved by {} m at t = {:.6g}, further than a grid can follow; expected "
                      "less than a thousand times its size",
                      grid_moves_to, t));
    Grid<dim> next_grid = grid_at<dim>(frame_.problem, grid_moves_to);
    next_grid.box = NumberedCells<dim>::around_points(frame_.grid, frame_.weights.cells_at(), motion, frame_.ranks);
    const auto work = force_.borrow();
    frame_.unknowns.spread(t, u, work->u);
    const std::vector<double> grid_v = frame_.unknowns.velocities(t, v);
    const GridFaces<dim> faces(frame_.problem, next_grid, conditions_.act_on_axis());
    const bool some_past_a_face = find_positions(t, next_grid, faces, work->u, grid_v);
    motion_since_deformation_ += motion;
    move_points(t, *work, grid_v);
    if (some_past_a_face) faces.put_back(points_);
    if (next_grid.box != frame_.grid.box) {
      const auto now_of = NumberedCells<dim>::template now_of<Basis>(frame_.grid, next_grid, frame_.body.fields);
      const int functions = frame_.body.fields * Basis::count(next_grid);
      conditions_.renumber(now_of, functions);
      deformation_.renumber(now_of, static_cast<std::size_t>(functions));
    }
    ++frame_.phase;
    frame_.grid_moved = grid_moves_to;
    frame_.grid = std::move(next_grid);
    sort_points();
  }

  const ConservationCheck<dim>& conservation() const { return transfer_.conservation(); }
  void archive(const StateArchive& state) {
    state.none_or(static_cast<std::size_t>(dim) * frame_.functions_of_grid(), "start_velocity", start_velocity_);
    state("motion_since_deformation", motion_since_deformation_);
    transfer_.conservation().archive(state);
  }

 private:
  // Whether no external forces act on the body.
  bool is_free() const {
    const Problem& problem = frame_.problem;
    return problem.supports.empty() && problem.walls.empty() && problem.rigid.empty() && problem.forces.empty() &&
           problem.tractions.empty() && !problem.has_body_force() && !problem.load && !conditions_.act_on_axis() &&
           is_undamped(problem.damping.strategy);
  }

  // Computes the positions to which grid_u and grid_v take the points, before anything changes: a run that ends here
  // still has its state. Throws PointLost if one is outside the next grid. Returns whether one has to be put back onto
  // a face.
  bool find_positions(double t, Grid<dim>& next_grid, const GridFaces<dim>& faces, const std::vector<double>& grid_u,
                      const std::vector<double>& grid_v) {
    const std::size_t none = points_.cells();
    std::size_t first_outside = none;  // the first cell with a point past a face
    bool all_have_numbers = true;
    const NextCells<dim> next_cells(next_grid);
    order_.cells().resize(points_.size());
    PointMotion<B, K>& motion = transfer_.motion();
    const RigidFaces<K> rigid_faces = conditions_.faces_of_rigid_bodies(t, grid_u.data());
    std::mutex outside_is_written;
    const auto find_cells = [&](std::size_t k) {
      if (!points_.has_domains()) rigid_faces.put_back(points_, k, frame_.grid, frame_.weights.cell_at(k), motion.x);
      const auto found = next_cells.find(points_, k, frame_.weights.cell_at(k), motion.x, order_.cells());
      if (found.all_inside && found.all_have_numbers) return;
      const std::scoped_lock lock(outside_is_written);
      if (!found.all_inside) first_outside = std::min(first_outside, k);
      all_have_numbers = all_have_numbers && found.all_have_numbers;
    };
    transfer_.move(points_, frame_.weights, frame_.corner_sum, inertia_.node_mass(), grid_u, grid_v, start_velocity_,
                   find_cells);
    // Slopes may take a point further than the nodes around it.
    if (!is_so_for_all(frame_.ranks, all_have_numbers)) {
      next_grid.box = {};
      const NextCells<dim> of_all(next_grid);
      for_each_block(points_.cells(), [&](std::size_t k) {
        of_all.find(points_, k, frame_.weights.cell_at(k), motion.x, order_.cells());
      });
    }
    std::string lost;
    CellPlace lost_from;
    for (std::size_t k = first_outside; k < none && lost.empty(); ++k) {
      lost_from = place_of_cell(points_, k);
      for (std::size_t p = points_.begin(k); p < points_.end(k) && lost.empty(); ++p) {
        for (int d = 0; d < dim && lost.empty(); ++d) {
          const Axis& axis = next_grid.axes[d];
          const double x = motion.x[d][p];
          if (faces.keeps(d, x)) continue;
          lost = fmt::format(
              "{} left the grid at {} = {:.6g}, outside {:.6g} to {:.6g}; expected a larger grid, a support or a wall",
              to_string(frame_.account().place(k, p)), "xyz"[d], x, axis.min(), axis.max());
        }
      }
    }
    lost = first_text(frame_.ranks, lost, lost_from);
    if (!lost.empty()) throw PointLost(lost);
    return first_outside < none;
  }

  // Updates the points: x_p += Σ N_ip u_i, V_p *= det f_p, and velocities by the scene's transfer.
  void move_points(double t, typename InternalForce<B, K>::Work& work, const std::vector<double>& grid_v) {
    const double* grid_u = work.u.data();
    transfer_.take_velocity(frame_.grid, points_, frame_.weights, inertia_.node_mass(), work.u, grid_v, start_velocity_,
                            inertia_.impulse(grid_v, start_velocity_));
    keep_spin(work.u, grid_v);
    force_.laws().take_means(grid_u, work);
    force_.points().visit(grid_u, [&](std::size_t m, Block& block) {
      if (!force_.laws().is_finite(m)) return;
      force_.laws().average(m, block, work);
      frame_.body.materials[m]->end_phase(block);
      double* V = points_.volume.data() + block.first;
      for (std::size_t q = 0; q < block.count; ++q) V[q] *= determinant<K>(plus_identity<K>(block.H_at(q)));
    });
    if constexpr (B::window > 1) {
      for_each_block(points_.cells(), [&](std::size_t k) {
        for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) move_corners(k, p, grid_u);
      });
    }
    points_.x.swap(transfer_.motion().x);
    conditions_.end_phase(t, grid_u);
  }

  // Transfers the spin of the relative inertia: δ_i has an angular momentum Σ δ_i d_i × ḋ_i, d_i = u_i − Σ_k w_k u_k,
  // when the phase ends, which apic's points take over as spin, so that none is lost. Points that store a gradient
  // cannot take it.
  void keep_spin([[maybe_unused]] const std::vector<double>& grid_u,
                 [[maybe_unused]] const std::vector<double>& grid_v) {
    if constexpr (dim > 1 && !AffineVelocity<B, K>::carries_gradient) {
      const std::vector<AddedInertia>& all_added = inertia_.of_functions().added();
      if (frame_.problem.phase.transfer != Transfer::apic || all_added.empty()) return;
      constexpr std::span<const Turn> about = dimension_info(dim).turns;
      constexpr std::size_t turns = about.size();
      const std::vector<double>& m = inertia_.node_mass();
      std::vector<double> spin(turns * m.size());  // δ_i (d_i × ḋ_i)/m_i
      for (const AddedInertia& added : all_added) {
        const auto i = static_cast<std::size_t>(added.function);
        if (added.relative_to.functions == 0 || !(m[i] > 0)) continue;
        const auto d = deviation<dim>(grid_u, added), d_dot = deviation<dim>(grid_v, added);
        const double delta = added.inertia / frame_.problem.mass.factor;
        for (std::size_t r = 0; r < turns; ++r) {
          const auto& [axis, from, to] = about[r];
          const double turn = d[from] * d_dot[to] - d[to] * d_dot[from];
          spin[turns * i + r] = delta * turn / m[i];
        }
      }
      for_each_block(points_.cells(), [&](std::size_t k) {
        for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) {
          const auto N = frame_.weights.N(k, p);
          for (std::size_t r = 0; r < turns; ++r) {
            double of_point = 0;
            for (int a = 0; a < per_cell; ++a)
              of_point += N[a] * spin[turns * static_cast<std::size_t>(frame_.weights.function(k, a)) + r];
            const auto& [axis, from, to] = about[r];
            points_.B_apic[dim * to + from][p] += of_point / 2;
            points_.B_apic[dim * from + to][p] -= of_point / 2;
          }
        }
      });
    }
  }

  // Moves the corners of a domain, x_c += Σ_i N_i(x_c) u_i.
  void move_corners(std::size_t k, std::size_t p, const double* grid_u) {
    const auto cell = frame_.grid.cell_at(points_.cell[k]);
    const auto domain = Domain<dim>::in_grid(points_, p, frame_.grid);
    for (int c = 0; c < domain.corners; ++c) {
      const auto at_corner = Basis::evaluate(frame_.grid, cell, domain.x[c]);
      for (int d = 0; d < dim; ++d) {
        double u_c = 0;
        for (int a = 0; a < per_cell; ++a)
          u_c += at_corner.N[a] * grid_u[static_cast<std::size_t>(dim * frame_.weights.function(k, a) + d)];
        points_.corner[dim * c + d][p] += u_c;
      }
    }
  }

  void sort_points() {
    if constexpr (B::window > 1) {
      for (auto from = halve_wide_domains(points_, frame_.grid); !from.empty();
           from = halve_wide_domains(points_, frame_.grid)) {
        refuse_folded_domains(points_);
        take_materials(frame_.body, from);
        // Halves have the deformation of their corners.
        motion_since_deformation_ = std::numeric_limits<double>::infinity();
      }
      order_.sort(points_, frame_.grid);
    } else {
      if (frame_.ranks) {
        Migration<K> migration(*frame_.ranks, frame_.body);
        migration.even_out(frame_.cells_of_ranks, frame_.grid, order_.cells());
        migration.run(frame_.cells_of_ranks, frame_.grid, order_.cells());
      }
      order_.sort_by_cells(points_, frame_.grid);
    }
    std::vector<std::vector<double>>& unused = force_.unused_histories();
    for (std::size_t m = 0; m < unused.size(); ++m) frame_.body.materials[m]->reorder(order_.order(), unused[m]);
  }

  PhaseFrame<B, K>& frame_;
  MaterialPoints<dim>& points_ = frame_.body.points;
  InternalForce<B, K>& force_;
  const PhaseInertia<B, K>& inertia_;
  Conditions<K>& conditions_;
  VelocityTransfer<B, K> transfer_;
  PointOrder<dim> order_;
  DeformationFromPositions<B, K> deformation_;
  double motion_since_deformation_ = 0;  // since the deformation was taken from the positions, at most [cells]
  std::vector<double> start_velocity_;   // over the grid's functions, (functions × dim)
};

}  // namespace stillpoint
