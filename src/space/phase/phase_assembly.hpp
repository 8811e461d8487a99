// The parts of a phase, and the order in which they begin.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "scene/controlled_loads.hpp"
#include "space/boundary/conditions.hpp"
#include "space/grid/cut_cells.hpp"
#include "space/grid/sliver_extension.hpp"
#include "space/phase/initial_state.hpp"
#include "space/phase/internal_force.hpp"
#include "space/phase/motion_limit.hpp"
#include "space/phase/phase_frame.hpp"
#include "space/phase/phase_inertia.hpp"
#include "space/phase/remap.hpp"
#include "space/phase/resting_parts.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
struct PhaseAssembly {
  static constexpr int dim = dimensions(K);

  /// Places the bodies and begins the first phase, or the first one of a stage.
  PhaseAssembly(const Problem& whole, const PhaseBegin& begin)
      : problem(without_reference_loads(whole)),
        frame(problem, static_cast<const CarriedBodyOf<K>*>(begin.carried), begin.ranks),
        conditions(problem, whole, frame.grid, frame.body, frame.within_shapes(), frame.account().shortest_time()) {
    if (frame.moves_on()) set_initial_velocity(problem, frame.body);
    frame.share_out_points();
    extend_into_slivers();
    if (begin.carried) {
      const auto* const points = static_cast<const CarriedBodyOf<K>*>(begin.carried);
      conditions.take_over(points->conditions);
      if (frame.begins_from_other_run(points)) {
        conditions.leave_placed(*points, frame.grid);
      } else {
        conditions.place_new_loads(*points, frame.grid);
      }
      rest.take_over(begin.carried->rest);
      if (stage_gives_stresses()) force.take_new_materials();
    }
    begin_phase(begin.t);
  }
  PhaseAssembly(const PhaseAssembly&) = delete;
  PhaseAssembly& operator=(const PhaseAssembly&) = delete;

  /// Begins a phase at t with the points where they are, in their order.
  void begin_phase(double t) {
    place_functions(t);
    remap.take_deformation();
    begin_forces(t);
  }
  /// Resumes the phase that began at t, with the points and their deformation as they were then.
  void resume_phase(double t) {
    place_functions(t);
    begin_forces(t);
    remap.resume(t);
  }

  const Problem problem;  // without the loads that a displacement drives
  PhaseFrame<B, K> frame;
  Conditions<K> conditions;
  InternalForce<B, K> force{frame};
  PhaseInertia<B, K> inertia{frame};
  MotionLimit<B, K> limit{frame, force};
  Remap<B, K> remap{frame, force, inertia, conditions};
  std::vector<double> constant_force;  // constant part of F, (n)
  RestingParts<B, K> rest{frame, force, limit, conditions, constant_force};

 private:
  // Whether laws of the stage begin with stresses that are not their own answers.
  bool stage_gives_stresses() const {
    return problem.present_stage && (!problem.present_stage->change.empty() || problem.present_stage->K0);
  }
  void make_weights() {
    frame.make_weights();
    force.take_points();
  }
  HeldUnknowns hold(double t, const std::vector<char>& reached) {
    return conditions.hold(t, frame.functions, frame.body.points, frame.weights, reached, frame.ranks);
  }
  void place_functions(double t) {
    make_weights();
    std::vector<char> reached = frame.reached_functions();
    HeldUnknowns held = hold(t, reached);
    rest.hold(t, reached, held);
    frame.unknowns.begin_phase(std::move(reached), std::move(held), frame.extension);
    rest.begin_phase();
    limit.begin_phase(/*by_reach=*/remap.follows_positions());
  }
  void begin_forces(double t) {
    force.begin_phase(t);
    inertia.begin_phase();
    constant_force.assign(frame.size(), 0);
    conditions.begin_phase(
        inertia.parts(), t, [this] { return frame.bound_of_functions(); }, constant_force);
  }

  // Extends functions into cells that the body hardly reaches, but only in a body with a single phase: in later phases
  // it is not known where in a cell the body ends.
  void extend_into_slivers() {
    std::vector<std::vector<CellShares>> covered(static_cast<std::size_t>(frame.body.fields));  // by each field
    for (std::size_t k = 0; k < frame.body.covered.size(); ++k)
      covered[static_cast<std::size_t>(frame.body.points.field_of(k))].push_back(std::move(frame.body.covered[k]));
    frame.body.covered.clear();
    std::vector<CutCells<dim>> cut;  // likewise
    for (const std::vector<CellShares>& of_field : covered) cut.emplace_back(frame.grid, of_field, B::degree);
    if (std::ranges::all_of(cut, [](const auto& of_field) { return of_field.slivers().empty(); })) return;
    make_weights();
    const std::vector<char> reached = frame.reached_functions();
    const HeldUnknowns held = hold(0, reached);
    const auto is_held = [&](int function, int i) {
      const int unknown = dim * function + i;
      return held.is_prescribed(unknown) || held.is_guided(unknown);
    };
    frame.extension = ExtendedFunctions(frame.functions_of_grid());
    for (int field = 0; field < frame.body.fields; ++field) {
      const int first = field * frame.functions.count_of_field();
      // A function may follow others only if each of its held components is held in them too.
      const auto may_follow = [&](int function, const std::vector<ExtendedFunctions::Source>& sources) {
        return std::ranges::all_of(sources, [&](const ExtendedFunctions::Source& source) {
          bool may = reached[static_cast<std::size_t>(first + source.function)] != 0;
          for (int i = 0; i < dim; ++i)
            may = may && (!is_held(first + function, i) || is_held(first + source.function, i));
          return may;
        });
      };
      const SliverExtension<typename BasisOfOneCell<B>::type, dim> extension(
          frame.grid, cut[static_cast<std::size_t>(field)], may_follow);
      frame.body.quadrature.slivers += extension.slivers();
      if (frame.moves_on()) continue;
      frame.body.quadrature.joined += extension.joined();
      frame.extension.add(extension.functions(), first);
    }
  }
};

}  // namespace stillpoint
