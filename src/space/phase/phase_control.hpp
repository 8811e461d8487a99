// How a phase ends and the next begins, and its saved state: that of its points, and what accepted steps have changed.
// The rest follows from these.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_assembly.hpp"
#include "space/points/domain_halving.hpp"
#include "space/points/saved_points.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PhaseControlOf final : public PhaseControl {
  static constexpr int dim = dimensions(K);

 public:
  /// all: must outlive this object.
  explicit PhaseControlOf(PhaseAssembly<B, K>& all) : all_(all) {}

  double progress(double t, ConstVec u) override {
    if (!all_.frame.moves_on()) return 0;
    if (all_.problem.phase.max_motion == 0 || all_.rest.is_pushed()) return 1;
    if (all_.conditions.ask_for_next_phase(u)) return 1;
    return all_.limit.progress(t, u);
  }
  std::vector<double> begin_next(double t, ConstVec u, ConstVec v) override {
    all_.rest.end_phase(t, u);
    all_.remap.end_phase(t, u, v, all_.limit.largest_motion(u));
    all_.begin_phase(t);
    return all_.remap.begin_motion(t);
  }
  void update_multipliers(double t, ConstVec u, bool evenly, Vec R, TrialState& of) override {
    const auto work = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    all_.conditions.update_multipliers(t, work->u.data(), evenly, R, of.reactions);
  }
  void change_materials(const std::map<std::string, MaterialSpec>& materials) override {
    stillpoint::change_materials(all_.frame.body, materials, all_.problem, all_.frame.moves_on());
    all_.force.take_new_materials();
    all_.rest.wake();
  }
  RestFigures rest_figures(double t, ConstVec reactions) const override { return all_.rest.figures(t, reactions); }
  TransferErrors transfer_errors() const override {
    const auto& kept = all_.remap.conservation();
    return {kept.mass(), kept.momentum(), kept.angular_momentum(), all_.inertia.of_functions().largest_added_mass()};
  }

  void archive(const StateArchive& state) override {
    PhaseFrame<B, K>& frame = all_.frame;
    Body<K>& body = frame.body;
    double t = frame.held().start();
    state("began_at", t);
    state("phase", frame.phase);
    // A saved state is that of one process, whatever number of ranks leaves it or goes on from it.
    if (frame.ranks) Migration<K>(*frame.ranks, body).gather(frame.grid);
    if (body.points.has_domains()) {
      if (const std::vector<int> from = archive_number_of_points(state, body.points); !from.empty())
        take_materials(body, from);
    }
    state("grid_moved", frame.grid_moved);
    for (std::size_t m = 0; m < body.materials.size(); ++m)
      state(fmt::format("memory_of_material_{}", m), body.materials[m]->memory());
    std::vector<int> numbered;
    if (frame.moves_on()) {
      numbered = archive_numbered_cells(state);
      archive_points(state, body.points);
    }
    all_.conditions.archive(state);
    if (state.restores() && frame.moves_on()) take_saved_grid(numbered);
    if (state.restores()) {
      frame.share_out_points();
    } else if (frame.ranks) {
      Migration<K>(*frame.ranks, body).keep_own(frame.cells_of_ranks, frame.grid);
    }
    all_.rest.archive(state.part("rest"));
    if (state.restores() && frame.moves_on()) {
      all_.resume_phase(t);
      all_.conditions.archive(state);  // replaces the initial state of the phase by the saved one
    }
    all_.force.archive(state);
    all_.limit.archive(state);
    all_.remap.archive(state);
    all_.inertia.archive(state);
  }

 private:
  static constexpr std::size_t ends = 2 * dim;

  std::vector<int> archive_numbered_cells(const StateArchive& state) {
    std::vector<int> numbered;
    for (const CellRange& along : all_.frame.grid.box) numbered.push_back(along.first), numbered.push_back(along.end);
    state("numbered_cells", numbered);
    if (numbered.size() != ends) throw StateError("its cells are those of a grid of other dimensions");
    return numbered;
  }
  // Restores the grid from the saved displacement of the followed wall, and checks the order of the saved points.
  void take_saved_grid(const std::vector<int>& numbered) {
    PhaseFrame<B, K>& frame = all_.frame;
    const Grid<dim> before = std::exchange(frame.grid, saved_grid_at<dim>(all_.problem, frame.grid_moved));
    for (std::size_t d = 0; d < dim; ++d) {
      const CellRange along{numbered[2 * d], numbered[2 * d + 1]};
      const bool are_cells = 0 <= along.first && along.first < along.end && along.end <= frame.grid.axes[d].cells();
      if (along != CellRange{} && !are_cells) throw StateError("its cells are not those of the grid");
      frame.grid.box[d] = along;
    }
    const std::string fault = disorder_of(frame.body.points, frame.grid.cells(), frame.body.numbers());
    if (!fault.empty()) throw StateError(fault);
    all_.remap.take_saved_numbers(before);
  }

  PhaseAssembly<B, K>& all_;
};

}  // namespace stillpoint
