// Parts of a body that rest while others move: their functions are held where they are through a phase, and the laws of
// their points are not evaluated, since nothing changes there.
//
// With the share τ of the scene, a function has been quiet in a phase if it moved by no more than τ of the largest
// motion in it. It rests in the next phase if it and all functions that share a cell with it have been quiet while that
// motion came to 0.2 cells: in two phases of the usual length, or in as many steps as make them. What then holds it is
// out of balance by Q = F − R, which is looked at when the phase ends: the function and those that share a cell with it
// move again once
//
//   |Q| > τ S,   S² = F² + Σ r²   with the forces r of its cells' corners,
//
// the forces of the stresses around it. The root mean square of Q over all that rests, beside that of S, is reported:
// holding many functions by a little adds up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scene/throw_scene_error.hpp"
#include "space/boundary/conditions.hpp"
#include "space/phase/internal_force.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/motion_limit.hpp"
#include "space/phase/phase_frame.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class RestingParts {
  static constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;

 public:
  /// The arguments must outlive this object. Throws SceneError if a law changes its stress without a motion.
  RestingParts(const PhaseFrame<B, K>& frame, InternalForce<B, K>& force, const MotionLimit<B, K>& limit,
               const Conditions<K>& conditions, const std::vector<double>& load)
      : frame_(frame), force_(force), limit_(limit), conditions_(conditions), load_(load) {
    const auto stays = [](const auto& law) { return law->info().stress_stays || !law->info().history_dependent; };
    if (share() > 0 && !std::ranges::all_of(frame.body.materials, stays))
      throw_scene_error("phase.rest",
                        "needs laws whose stress stays where nothing moves, which viscosity and softening "
                        "do not leave");
  }

  bool act() const { return share() > 0 && frame_.phase > 0 && conditions_.loads_are_constant(); }

  /// Holds what rests when a phase begins; all other conditions come first. reached: (functions).
  void hold(const std::vector<char>& reached, HeldUnknowns& held) {
    if (!act()) return;
    follow_grid();
    rests_.assign(quiet_.size(), 0);
    for (std::size_t f = 0; f < quiet_.size(); ++f) {
      rests_[f] = static_cast<char>(reached[f] && quiet_[f] >= long_enough);
      for (int i = 0; i < dim; ++i) {
        const int unknown = dim * static_cast<int>(f) + i;
        if (held.is_guided(unknown)) rests_[f] = 0;
      }
    }
    keep_neighbours_of(
        rests_, [](char rests) { return rests == 0; }, 0);
    for (std::size_t f = 0; f < rests_.size(); ++f) {
      for (int i = 0; rests_[f] && i < dim; ++i) {
        const int unknown = dim * static_cast<int>(f) + i;
        if (!held.is_prescribed(unknown)) held.let_rest(unknown);
      }
    }
  }
  /// Lets the cells rest whose functions are all held where they are; the unknowns of the phase are known.
  void begin_phase() {
    if (!act()) return;
    const HeldUnknowns& held = frame_.held();
    std::vector<char> still(dim * frame_.functions_of_grid(), 0);  // of the unknowns
    for (const int unknown : held.prescribed()) still[static_cast<std::size_t>(unknown)] = 1;
    for (const std::size_t s : held.displaced()) still[static_cast<std::size_t>(held.prescribed()[s])] = 0;
    const MaterialPoints<dim>& points = frame_.body.points;
    std::vector<char> cells(points.cells(), 1);
    std::size_t resting = 0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      for (int a = 0; a < per_cell; ++a) {
        for (int i = 0; i < dim; ++i)
          cells[k] &= still[static_cast<std::size_t>(dim * frame_.weights.function(k, a) + i)];
      }
      if (cells[k]) resting += points.end(k) - points.begin(k);
    }
    figures_.points += static_cast<double>(resting) / static_cast<double>(points.size());
    ++phases_;
    force_.let_rest(cells);
  }
  /// Looks at a phase that ends at (t, u), before the points move on.
  void end_phase(double t, ConstVec u) {
    if (share() == 0 || !conditions_.loads_are_constant()) return;
    quiet_.resize(frame_.functions_of_grid(), 0);
    rests_.resize(quiet_.size(), 0);
    counts_ = counts();
    keep_loads();
    std::vector<char> moves = moved(u);
    if (std::ranges::any_of(rests_, [](char rests) { return rests != 0; })) let_go_what_is_out_of_balance(t, u, moves);
    const double motion = limit_.largest_motion(u);
    for (std::size_t f = 0; f < quiet_.size(); ++f) quiet_[f] = moves[f] ? 0 : quiet_[f] + motion;
  }

  /// Lets everything move again in the next phase.
  void wake() { quiet_.assign(quiet_.size(), 0); }

  /// What has rested so far, on average over the phases.
  RestFigures figures() const {
    RestFigures mean = figures_;
    if (phases_ > 0) mean.points /= static_cast<double>(phases_);
    return mean;
  }
  void archive(const StateArchive& state) {
    state.none_or(frame_.functions_of_grid(), "quiet", quiet_);
    state.none_or(dim * frame_.functions_of_grid(), "loads", F_);
    if (state.restores() && !quiet_.empty()) counts_ = counts();
    state("phases", phases_, "resting_points", figures_.points, "held_force", figures_.held_force);
  }

 private:
  using Counts = std::array<int, dim>;
  static constexpr double long_enough = 0.2;  // [cells]

  double share() const { return frame_.problem.phase.rest; }
  Counts counts() const {
    Counts along;
    for (int d = 0; d < dim; ++d) along[static_cast<std::size_t>(d)] = frame_.functions.count_along(d);
    return along;
  }

  // Renumbers the functions after the grid has been given lines, or has lost some, at the wall that it follows.
  void follow_grid() {
    const Counts now = counts();
    if (quiet_.empty()) quiet_.assign(frame_.functions_of_grid(), 0);
    if (counts_ == Counts{} || now == counts_) {
      counts_ = now;
      return;
    }
    const Problem& problem = frame_.problem;
    const auto wall = std::ranges::find(problem.walls, problem.grid.follow, &WallSpec::name);
    const bool at_end = wall == problem.walls.end() || is_upper(wall->face);
    std::vector<double> before(frame_.functions_of_grid(), 0), F_before(dim * before.size(), 0);
    before.swap(quiet_);
    F_before.swap(F_);
    const std::size_t of_field = quiet_.size() / static_cast<std::size_t>(frame_.body.fields);
    const std::size_t of_field_before = before.size() / static_cast<std::size_t>(frame_.body.fields);
    for (std::size_t f = 0; f < quiet_.size(); ++f) {
      std::size_t rest = f % of_field, stride = 1, old = f / of_field * of_field_before;
      bool is_new = false;
      for (std::size_t d = 0; d < dim; ++d) {
        const int index = static_cast<int>(rest % static_cast<std::size_t>(now[d]));
        const int was = at_end ? index : index + counts_[d] - now[d];
        is_new = is_new || was < 0 || was >= counts_[d];
        if (!is_new) old += static_cast<std::size_t>(was) * stride;
        rest /= static_cast<std::size_t>(now[d]);
        stride *= static_cast<std::size_t>(counts_[d]);
      }
      if (is_new) continue;
      quiet_[f] = before[old];
      for (std::size_t i = 0; i < dim; ++i) F_[dim * f + i] = F_before[dim * old + i];
    }
    counts_ = now;
  }

  // Sets `value` at all functions that share a cell with one at which is(value there) held before.
  template <class Is>
  void keep_neighbours_of(std::vector<char>& of_functions, const Is& is, char value) const {
    const std::vector<char> before = of_functions;
    const auto at = [&](std::size_t k, int a) { return static_cast<std::size_t>(frame_.weights.function(k, a)); };
    for (std::size_t k = 0; k < frame_.body.points.cells(); ++k) {
      bool some = false;
      for (int a = 0; a < per_cell; ++a) some = some || is(before[at(k, a)]);
      for (int a = 0; some && a < per_cell; ++a) of_functions[at(k, a)] = value;
    }
  }

  // Whether a function has moved in this phase, by more than the share of the largest motion, or was moved,
  // (functions).
  std::vector<char> moved(ConstVec u) const {
    const double allowed = share() * limit_.largest_motion(u);
    const HeldUnknowns& held = frame_.held();
    std::vector<char> moves(quiet_.size(), 0);
    for (std::size_t k = 0; k < u.size(); ++k)
      if (!(limit_.motion(k, u) <= allowed)) moves[static_cast<std::size_t>(frame_.dofs().free[k] / dim)] = 1;
    for (const std::size_t s : held.displaced()) moves[static_cast<std::size_t>(held.prescribed()[s] / dim)] = 1;
    return moves;
  }

  void let_go_what_is_out_of_balance(double t, ConstVec u, std::vector<char>& moves) {
    const auto work = force_.borrow();
    PhaseTrial trial(force_.borrow_trial());
    const HeldUnknowns& held = frame_.held();
    trial.t = t;
    trial.reactions.assign(held.prescribed().size() + conditions_.other_reactions(), 0);
    frame_.unknowns.spread(t, u, trial.arrays->u);
    std::vector<double> R(u.size());
    force_.evaluate(trial, R, *work);
    conditions_.add_force(t, trial.arrays->u.data(), R, trial.reactions);
    const std::vector<double> squares = squared_forces_around(work->nodal.corner);
    std::vector<char> released(moves.size(), 0);
    double all_held = 0, all_around = 0;
    for (std::size_t s = 0; s < held.prescribed().size(); ++s) {
      const auto unknown = static_cast<std::size_t>(held.prescribed()[s]), f = unknown / dim;
      if (!rests_[f] || held.owner(s) != HeldUnknowns::nobody) continue;
      const double Q = F_[unknown] - trial.reactions[s];
      all_held += Q * Q;
      all_around += squares[f] / dim;
      if (!(Q * Q <= share() * share() * squares[f])) released[f] = 1;
    }
    if (all_around > 0) figures_.held_force = std::max(figures_.held_force, std::sqrt(all_held / all_around));
    keep_neighbours_of(
        released, [](char is_released) { return is_released != 0; }, 1);
    for (std::size_t f = 0; f < moves.size(); ++f) moves[f] |= released[f];
  }
  // F of the unknowns that are free in this phase; those at rest bear the load that they had when they came to rest.
  void keep_loads() {
    F_.resize(dim * quiet_.size(), 0);
    for (std::size_t k = 0; k < load_.size(); ++k) F_[static_cast<std::size_t>(frame_.dofs().free[k])] = load_[k];
  }
  // F² + Σ r² of the forces r of the corners at each function, (functions) [N²].
  std::vector<double> squared_forces_around(const std::vector<double>& corner) const {
    std::vector<double> squares(frame_.functions_of_grid(), 0);
    for (std::size_t unknown = 0; unknown < F_.size(); ++unknown) squares[unknown / dim] += F_[unknown] * F_[unknown];
    for (std::size_t k = 0; k < frame_.body.points.cells(); ++k) {
      for (std::size_t a = 0; a < per_cell; ++a) {
        double& sum = squares[static_cast<std::size_t>(frame_.weights.function(k, static_cast<int>(a)))];
        for (std::size_t i = 0; i < dim; ++i) {
          const double r = corner[dim * (per_cell * k + a) + i];
          sum += r * r;
        }
      }
    }
    return squares;
  }

  const PhaseFrame<B, K>& frame_;
  InternalForce<B, K>& force_;
  const MotionLimit<B, K>& limit_;
  const Conditions<K>& conditions_;
  const std::vector<double>& load_;  // F of the present phase, (n) [N]
  std::vector<double> quiet_;        // the largest motions while each function has been quiet, (functions) [cells]
  std::vector<char> rests_;          // whether it rests in the present phase
  std::vector<double> F_;            // the load on each unknown when it was free last, (functions × dim) [N]
  Counts counts_{};                  // the functions along the axes to which these belong
  long phases_ = 0;                  // in which parts could rest
  RestFigures figures_;              // points: the sum over these phases
};

}  // namespace stillpoint
