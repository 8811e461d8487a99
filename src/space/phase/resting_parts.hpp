// Parts of a body that rest while others move: their functions are held where they are through a phase, and the laws of
// their points are not evaluated, since nothing changes there.
//
// With the share τ of the scene, a function has been quiet in a phase if it moved by no more than τ of the largest
// motion in it. It rests in the next phase if it and all functions that share a cell with it have been quiet while that
// motion came to 0.2 cells: in two phases of the usual length, or in as many steps as make them. What then holds it is
// out of balance by Q = F − R: the function and those that share a cell with it move again in the phase after that in
// which
//
//   |Q| > τ S,   S² = F² + Σ r²   with the forces r of its cells' corners,
//
// the forces of the stresses around it. Once the root mean square of Q beside what moves passes 4 τ of that of S, as
// when a wall begins to push, the phase ends at once, all within a few cells moves again, and for a while parts have to
// be quiet for longer, so that a body that is shaken does not change phases for their sake. Holding many functions by a
// little adds up: Σ |Q| over all that rests is reported beside the forces that pass through the body.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/conditions.hpp"
#include "space/grid/followed_functions.hpp"
#include "space/phase/internal_force.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/motion_limit.hpp"
#include "space/phase/phase_frame.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class RestingParts {
  static constexpr std::size_t dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;

 public:
  /// load: F of the present phase, (n). The arguments must outlive this object. Throws SceneError if a law changes its
  /// stress without a motion.
  RestingParts(const PhaseFrame<B, K>& frame, InternalForce<B, K>& force, const MotionLimit<B, K>& limit,
               const Conditions<K>& conditions, const std::vector<double>& load)
      : frame_(frame), force_(force), limit_(limit), conditions_(conditions), load_(load) {
    const auto stays = [](const auto& law) {
      return law->info().history_dependent && law->info().stress_stays && !law->info().viscous;
    };
    if (share() > 0 && !std::ranges::all_of(frame.body.materials, stays)) {
      throw_scene_error("phase.rest",
                        "is for soils that neither soften nor flow by viscosity: laws with a history, whose stress "
                        "stays where nothing moves");
    }
  }

  // --- a phase begins, in this order ---------------------------------------------------------------
  /// Holds what rests from t on; all other conditions come first. reached: whether material reaches a function,
  /// (functions).
  void hold(double t, const std::vector<char>& reached, HeldUnknowns& held) {
    began_ = t;
    if (!act()) return;
    follow_grid();
    std::vector<char> rests(quiet_.size());
    for (std::size_t f = 0; f < rests.size(); ++f) {
      bool may_rest = reached[f] && quiet_[f] >= long_enough_;
      for (std::size_t i = 0; i < dim; ++i) may_rest = may_rest && !held.is_guided(static_cast<int>(dim * f + i));
      rests[f] = static_cast<char>(may_rest);
    }
    spread_by_a_cell(0, rests);
    for (std::size_t unknown = 0; unknown < dim * rests.size(); ++unknown) {
      if (rests[unknown / dim] && !held.is_prescribed(static_cast<int>(unknown)))
        held.let_rest(static_cast<int>(unknown));
    }
  }
  /// Lets the cells rest whose functions are all held where they are; the unknowns of the phase are known.
  void begin_phase() {
    is_pushed_ = false;
    resting_share_ = 0;
    border_.clear();
    if (!act()) return;
    const std::vector<char> cells = resting_cells();
    force_.let_rest(cells);
    border_ = held_beside_what_moves();
    const MaterialPoints<static_cast<int>(dim)>& points = frame_.body.points;
    std::size_t resting = 0;
    for (std::size_t k = 0; k < cells.size(); ++k) resting += cells[k] ? points.end(k) - points.begin(k) : 0;
    double at_rest = 0, all = 0;
    for (const auto& [rests, of_rank] : of_all(frame_.ranks, std::array{resting, points.size()})) {
      at_rest += static_cast<double>(rests);
      all += static_cast<double>(of_rank);
    }
    resting_share_ = at_rest / all;
  }

  // --- during a phase, and at its end --------------------------------------------------------------
  /// Looks at the reactions after a step, (prescribed unknowns and others).
  void observe(ConstVec reactions) {
    constexpr double push = 4;  // beside the share by which a function alone is let go
    const auto [held, around] = sums_of_squares(border_, reactions);
    if (!(held <= push * share() * (push * share()) * around)) is_pushed_ = true;
  }
  /// Whether what moves pushes what rests, so that the phase has to end.
  bool is_pushed() const { return is_pushed_; }
  /// Looks at a phase that ends at (t, u), before the points move on.
  void end_phase(double t, ConstVec u) {
    if (share() == 0) return;
    add_present_phase(t, record_);
    if (!conditions_.let_parts_rest(t)) return;
    const std::size_t functions = frame_.functions_of_grid();
    quiet_.resize(functions, 0);
    loads_.resize(dim * functions, 0);
    counts_ = counts();
    for (std::size_t k = 0; k < load_.size(); ++k) loads_[unknown(k)] = load_[k];
    add_quiet(u);
    constexpr double a_phase_without_push = 0.9;
    long_enough_ = std::clamp(long_enough_ * (is_pushed_ ? 2 : a_phase_without_push), shortest_quiet, longest_quiet);
    squares_.assign(functions, 0);
    const bool some_may_rest = std::ranges::any_of(quiet_, [&](double quiet) { return quiet >= long_enough_; });
    const std::vector<Held> at_rest = held_at_rest();
    if (!at_rest.empty() || some_may_rest) let_go_what_is_out_of_balance(t, u, at_rest);
  }
  /// Lets everything move again in the next phase.
  void wake() { quiet_.assign(quiet_.size(), 0); }

  /// What has rested so far, at t in the present phase, in the state of an evaluation with these reactions.
  RestFigures figures(double t, ConstVec reactions) const {
    RestRecord now = record_;
    add_present_phase(t, now);
    return {.points = now.time > 0 ? now.points / now.time : 0,
            .held_force = std::max(now.held_force, held_share(held_at_rest(), t, reactions)),
            .may_rest = conditions_.let_parts_rest(t)};
  }
  /// The record of all phases that have ended.
  const RestRecord& record() const { return record_; }
  /// Before the first phase: goes on from the record of the stages before.
  void take_over(const RestRecord& from_stage) { record_ = from_stage; }
  /// Saves or restores what is known of earlier phases; a phase is resumed afterwards.
  void archive(const StateArchive& state) {
    if (share() == 0) return;
    const std::size_t functions = frame_.functions_of_grid();
    state.none_or(functions, "quiet", quiet_);
    state.none_or(dim * functions, "loads", loads_);
    state.none_or(functions, "forces_around", squares_);
    state("long_enough", long_enough_);
    record_.archive(state.part("record"));
    if (state.restores() && !quiet_.empty()) counts_ = counts();
  }

 private:
  static constexpr double shortest_quiet = 0.2, longest_quiet = 1.6;  // [cells]
  struct Held {
    std::size_t number, unknown;  // of the prescribed unknowns, and in the grid
  };
  using Counts = std::array<std::size_t, dim>;

  double share() const { return frame_.problem.phase.rest; }
  bool act() const { return share() > 0 && frame_.phase > 0 && conditions_.let_parts_rest(began_); }
  void add_present_phase(double t, RestRecord& to) const {
    to.time += t - began_;
    to.points += resting_share_ * (t - began_);
  }
  Counts counts() const {
    Counts along;
    for (std::size_t d = 0; d < dim; ++d)
      along[d] = static_cast<std::size_t>(frame_.functions.count_along(static_cast<int>(d)));
    return along;
  }
  std::size_t function(std::size_t cell, std::size_t a) const {
    return static_cast<std::size_t>(frame_.weights.function(cell, static_cast<int>(a)));
  }
  std::size_t unknown(std::size_t free) const { return static_cast<std::size_t>(frame_.dofs().free[free]); }

  // Renumbers what is known of the functions once the grid has followed its wall. There is one field of them: bodies in
  // contact do not rest.
  void follow_grid() {
    const Counts now = counts(), before = std::exchange(counts_, now);
    if (quiet_.empty()) quiet_.assign(frame_.functions_of_grid(), 0);
    if (before == Counts{} || before == now) return;
    const Problem& problem = frame_.problem;
    const auto wall = std::ranges::find(problem.walls, problem.grid.follow, &WallSpec::name);
    const bool at_end = wall == problem.walls.end() || is_upper(wall->face);
    const std::vector<std::size_t> from = numbers_before(before, now, at_end);
    quiet_ = renumbered(quiet_, from, 1);
    squares_ = renumbered(squares_, from, 1);
    loads_ = renumbered(loads_, from, dim);
  }

  // Sets `value` at all functions that share a cell with one that has it.
  void spread_by_a_cell(char value, std::vector<char>& of_functions) const {
    std::vector<char> takes_it(of_functions.size(), 0);
    for (std::size_t k = 0; k < frame_.body.points.cells(); ++k) {
      bool some = false;
      for (std::size_t a = 0; a < per_cell; ++a) some = some || of_functions[function(k, a)] == value;
      for (std::size_t a = 0; some && a < per_cell; ++a) takes_it[function(k, a)] = 1;
    }
    unite(frame_.ranks, std::span(takes_it));
    for (std::size_t f = 0; f < takes_it.size(); ++f)
      if (takes_it[f]) of_functions[f] = value;
  }
  // Whether all functions of a cell are held where they are, by supports or at rest, (cells).
  std::vector<char> resting_cells() const {
    const HeldUnknowns& held = frame_.held();
    std::vector<char> stays(dim * frame_.functions_of_grid(), 0);  // the unknowns
    for (const int prescribed : held.prescribed()) stays[static_cast<std::size_t>(prescribed)] = 1;
    for (const std::size_t s : held.displaced()) stays[static_cast<std::size_t>(held.prescribed()[s])] = 0;
    std::vector<char> cells(frame_.body.points.cells(), 1);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      for (std::size_t c = 0; c < dim * per_cell; ++c) cells[k] &= stays[dim * function(k, c / dim) + c % dim];
    }
    return cells;
  }
  // What is held by its rest alone.
  std::vector<Held> held_at_rest() const {
    const HeldUnknowns& held = frame_.held();
    std::vector<Held> all;
    for (std::size_t s = held.first_at_rest(); s < held.prescribed().size(); ++s)
      all.push_back({s, static_cast<std::size_t>(held.prescribed()[s])});
    return all;
  }
  // What of that is at functions of which some cells move.
  std::vector<Held> held_beside_what_moves() const {
    std::vector<char> moves(frame_.functions_of_grid(), 0);
    for (const std::size_t f : force_.points().moving_functions()) moves[f] = 1;
    unite(frame_.ranks, std::span(moves));
    std::vector<Held> beside = held_at_rest();
    std::erase_if(beside, [&](const Held& at) { return !moves[at.unknown / dim]; });
    return beside;
  }

  // Adds a phase to the time for which each function has been quiet, or begins it anew.
  void add_quiet(ConstVec u) {
    const double motion = limit_.largest_motion(u), allowed = share() * motion;
    for (double& quiet : quiet_) quiet += motion;
    for (std::size_t k = 0; k < u.size(); ++k)
      if (!(limit_.motion(k, u) <= allowed)) quiet_[unknown(k) / dim] = 0;
    const HeldUnknowns& held = frame_.held();
    for (const std::size_t s : held.displaced()) quiet_[static_cast<std::size_t>(held.prescribed()[s]) / dim] = 0;
  }
  double out_of_balance(const Held& at, ConstVec reactions) const { return loads_[at.unknown] - reactions[at.number]; }
  // Σ Q² and Σ S² over what is held; S² is that of all components of a function.
  std::pair<double, double> sums_of_squares(const std::vector<Held>& of, ConstVec reactions) const {
    double held = 0, around = 0;
    for (const Held& at : of) {
      const double Q = out_of_balance(at, reactions);
      held += Q * Q;
      around += squares_[at.unknown / dim] / static_cast<double>(dim);
    }
    return {held, around};
  }
  // Σ |Q| over all that rests, as a share of the forces that pass through the body, (Σ |F| + Σ |r|)/2 with the
  // reactions r of supports, springs and walls.
  double held_share(const std::vector<Held>& at_rest, double t, ConstVec reactions) const {
    double held = 0, passing = 0;
    for (const Held& at : at_rest) {
      held += std::abs(out_of_balance(at, reactions));
      passing += std::abs(loads_[at.unknown]);
    }
    if (held == 0) return 0;
    for (const double F : load_) passing += std::abs(F);
    const std::size_t of_supports = frame_.held().first_at_rest(), others = frame_.held().prescribed().size();
    for (std::size_t s = 0; s < reactions.size(); ++s)
      if (s < of_supports || s >= others) passing += std::abs(reactions[s]);
    for (const WallReaction& wall : conditions_.wall_reactions(t))
      passing += std::abs(wall.normal) + std::abs(wall.shear[0]) + std::abs(wall.shear[1]);
    return held / (passing / 2);
  }
  // Evaluates the forces at (t, u), and lets go what they put out of balance.
  void let_go_what_is_out_of_balance(double t, ConstVec u, const std::vector<Held>& at_rest) {
    const auto work = force_.borrow();
    PhaseTrial trial(force_.borrow_trial());
    trial.t = t;
    trial.reactions.assign(frame_.held().prescribed().size() + conditions_.other_reactions(), 0);
    frame_.unknowns.spread(t, u, trial.arrays->u);
    std::vector<double> R(u.size());
    force_.evaluate(trial, R, *work);
    conditions_.add_force(t, trial.arrays->u.data(), R, trial.reactions);
    add_forces_around(work->nodal.corner);

    record_.held_force = std::max(record_.held_force, held_share(at_rest, t, trial.reactions));
    std::vector<char> released(quiet_.size(), 0);
    for (const Held& at : at_rest) {
      const double Q = out_of_balance(at, trial.reactions);
      if (!(Q * Q <= share() * share() * squares_[at.unknown / dim])) released[at.unknown / dim] = 1;
    }
    constexpr int cells_around_a_push = 4;
    for (int cell = 0; cell < (is_pushed_ ? cells_around_a_push : 1); ++cell) spread_by_a_cell(1, released);
    for (std::size_t f = 0; f < released.size(); ++f)
      if (released[f]) quiet_[f] = 0;
  }
  // Adds S² = F² + Σ r² of the forces r of the corners at each function.
  void add_forces_around(const std::vector<double>& corner) {
    for (std::size_t unknown = 0; unknown < loads_.size(); ++unknown)
      squares_[unknown / dim] += loads_[unknown] * loads_[unknown];
    std::vector<double> of_corners(frame_.corner_sum.corners() + CornerSum::slack), of_functions(squares_.size());
    for (std::size_t c = 0; c < dim * per_cell * frame_.body.points.cells(); ++c)
      of_corners[c / dim] += corner[c] * corner[c];
    frame_.corner_sum.template sum_at_functions<1>(of_corners.data(), of_functions.data());
    for (std::size_t f = 0; f < squares_.size(); ++f) squares_[f] += of_functions[f];
  }

  const PhaseFrame<B, K>& frame_;
  InternalForce<B, K>& force_;
  const MotionLimit<B, K>& limit_;
  const Conditions<K>& conditions_;
  const std::vector<double>& load_;
  std::vector<double> quiet_;    // the largest motions while each function has been quiet, (functions) [cells]
  std::vector<double> loads_;    // F of each unknown when it was free last, (functions × dim) [N]
  std::vector<double> squares_;  // S² when the last phase ended, (functions) [N²]
  Counts counts_{};              // the functions along the axes to which these belong
  std::vector<Held> border_;     // what rests beside what moves
  bool is_pushed_ = false;
  double long_enough_ = shortest_quiet;  // how long what rests has to have been quiet [cells]
  double began_ = 0;                     // when the present phase did [s]
  double resting_share_ = 0;             // of the points in it
  RestRecord record_;                    // of the phases before it
};

}  // namespace stillpoint
