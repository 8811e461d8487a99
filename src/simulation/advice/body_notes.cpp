#include "simulation/advice/body_notes.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "scene/body_depth.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

bool is_gap(const BodyGap& pair) { return pair.cells > touching; }

std::string apart(const BodyGap& pair) {
  return fmt::format("body[{}] and body[{}] are {:.4g} m ({:.3g} cells) apart", pair.a, pair.b, pair.gap, pair.cells);
}

// For each body a number that is the same for those that touch, one by the other.
std::vector<std::size_t> touching_groups(std::size_t bodies, const std::vector<BodyGap>& pairs) {
  std::vector<std::size_t> group(bodies);
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (const BodyGap& pair : pairs) {
    if (is_gap(pair)) continue;
    const std::size_t from = group[pair.b], to = group[pair.a];
    std::ranges::replace(group, from, to);
  }
  return group;
}

// The axes along which loads or moving supports act.
HeldAxes driven_axes(const Problem& problem) {
  const auto acts = [](const Expression& formula) { return !formula.constant() || formula({}, 0) != 0; };
  HeldAxes driven{};
  const auto add = [&](const std::vector<Expression>& components) {
    for (std::size_t axis = 0; axis < components.size(); ++axis) driven[axis] = driven[axis] || acts(components[axis]);
  };
  add(problem.body_force);
  for (const PointForceSpec& force : problem.forces) add(force.value);
  for (const TractionSpec& traction : problem.tractions) {
    add(traction.value);
    if (traction.pressure) driven.fill(true);
  }
  if (!problem.own_load.empty()) driven.fill(true);
  for (const SupportSpec& support : problem.supports)
    if (acts(support.motion)) driven[static_cast<std::size_t>(support.component)] = true;
  for (const WallSpec& wall : problem.walls)
    if (acts(wall.motion)) driven[static_cast<std::size_t>(axis_of(wall.face))] = true;
  for (const RigidSpec& rigid : problem.rigid) add(rigid.motion);
  if (problem.state == StressState::axisymmetric) driven[0] = false;  // a ring holds itself
  return driven;
}

// A gap across which alone a body is held.
struct HeldByGap {
  BodyGap gap;
  std::size_t body;
  std::string along;  // " along x"; empty: along none
};

// A body has to be held somehow, and along each axis along which anything is driven.
std::optional<HeldByGap> held_by_gap(const Problem& problem, const std::vector<BodyGap>& pairs,
                                     const std::vector<HeldAxes>& held) {
  const std::vector<std::size_t> group = touching_groups(held.size(), pairs);
  std::vector<HeldAxes> group_is_held(held.size(), HeldAxes{});
  for (std::size_t body = 0; body < held.size(); ++body)
    for (std::size_t axis = 0; axis < held[body].size(); ++axis)
      group_is_held[group[body]][axis] = group_is_held[group[body]][axis] || held[body][axis];
  const HeldAxes driven = driven_axes(problem);
  for (const BodyGap& pair : pairs) {
    if (!is_gap(pair) || !pair.bonded || group[pair.a] == group[pair.b]) continue;
    for (const std::size_t body : {pair.b, pair.a}) {
      const HeldAxes& axes = group_is_held[group[body]];
      if (std::ranges::none_of(axes, std::identity())) return HeldByGap{pair, body, ""};
      for (std::size_t axis = 0; axis < static_cast<std::size_t>(problem.dim); ++axis)
        if (driven[axis] && !axes[axis]) return HeldByGap{pair, body, std::string(" along ") + "xyz"[axis]};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> BodyNotes::of_laws(const LagrangianPhase& phase) {
  std::vector<std::string> notes;
  for (std::string& note : phase.diagnosis().notes_of_laws())
    if (told_.insert(note).second) notes.push_back(std::move(note));
  return notes;
}

std::vector<std::string> BodyNotes::at_start(const Problem& problem, const LagrangianPhase& phase) {
  std::vector<std::string> notes = of_laws(phase);
  const std::vector<BodyGap> pairs = phase.shape().body_gaps();
  if (pairs.empty()) return notes;
  const bool may_move = phase.info().updated_lagrangian || !problem.stop.wants_equilibrium();
  if (const auto found = may_move ? std::nullopt : held_by_gap(problem, pairs, phase.supports().held_bodies())) {
    throw_scene_error(fmt::format("body[{}]", found->body),
                      fmt::format("nothing holds it{}: {}, and only functions of the grid that reach both carry forces "
                                  "across the gap; expected a support, bodies that touch, or stop.residual = 0 and "
                                  "stop.time",
                                  found->along, apart(found->gap)));
  }
  for (const BodyGap& pair : pairs) {
    known_.insert({pair.a, pair.b});
    // A body that is placed where another one has settled lies on that one.
    constexpr double settled = 0.25;  // cells
    const bool is_placed_on_it = problem.phase.at_stages && pair.cells < settled;
    if (is_gap(pair) && !is_placed_on_it)
      notes.push_back(
          fmt::format("{} and share functions of the grid, which pull and push them across the gap; "
                      "expected smaller cells, a [[contact]] between them, or bodies that touch",
                      apart(pair)));
  }
  return notes;
}

std::vector<std::string> BodyNotes::later(const Problem& problem, const LagrangianPhase& phase) {
  std::vector<std::string> notes = of_laws(phase);
  const std::size_t bodies = problem.bodies.size();
  if (known_.size() == bodies * (bodies - 1) / 2) return notes;
  for (const BodyGap& pair : phase.shape().body_gaps()) {
    if (!known_.insert({pair.a, pair.b}).second) continue;
    if (!pair.bonded) {
      notes.push_back(
          fmt::format("{} and have no contact with each other, though both have one with a third: each goes "
                      "through the other; expected a [[contact]] between them",
                      apart(pair)));
      continue;
    }
    notes.push_back(fmt::format(
        "{} when they have come to share functions of the grid, which push them apart, or hold "
        "them together, before they touch; expected a [[contact]] between them, or smaller cells where they meet",
        apart(pair)));
  }
  return notes;
}

}  // namespace stillpoint
