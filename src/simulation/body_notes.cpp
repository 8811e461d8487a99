#include "simulation/body_notes.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

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

// A gap across which alone a body is held, and the body.
std::optional<std::pair<BodyGap, std::size_t>> held_by_gap(const std::vector<BodyGap>& pairs,
                                                           const std::vector<char>& held) {
  const std::vector<std::size_t> group = touching_groups(held.size(), pairs);
  std::vector<char> group_is_held(held.size(), 0);
  for (std::size_t body = 0; body < held.size(); ++body)
    if (held[body]) group_is_held[group[body]] = 1;
  for (const BodyGap& pair : pairs) {
    if (!is_gap(pair) || group[pair.a] == group[pair.b]) continue;
    for (const std::size_t body : {pair.b, pair.a})
      if (!group_is_held[group[body]]) return std::pair(pair, body);
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> BodyNotes::at_start(const Scene& scene, const LagrangianPhase& phase) {
  std::vector<std::string> notes;
  const std::vector<BodyGap> pairs = phase.body_gaps();
  if (pairs.empty()) return notes;
  const bool may_move = phase.info().updated_lagrangian || !scene.stop.wants_equilibrium();
  if (const auto found = may_move ? std::nullopt : held_by_gap(pairs, phase.held_bodies())) {
    throw_scene_error(scene, fmt::format("body[{}]", found->second),
                      fmt::format("nothing holds it: {}, and only functions of the grid that reach both carry forces "
                                  "across the gap; expected a support, bodies that touch, or stop.residual = 0 and "
                                  "stop.time",
                                  apart(found->first)));
  }
  for (const BodyGap& pair : pairs) {
    known_.insert({pair.a, pair.b});
    if (is_gap(pair))
      notes.push_back(
          fmt::format("{} and share functions of the grid, which pull and push them across the gap; "
                      "expected smaller cells, or bodies that touch",
                      apart(pair)));
  }
  return notes;
}

std::vector<std::string> BodyNotes::later(const Scene& scene, const LagrangianPhase& phase) {
  std::vector<std::string> notes;
  const std::size_t bodies = scene.bodies.size();
  if (known_.size() == bodies * (bodies - 1) / 2) return notes;
  for (const BodyGap& pair : phase.body_gaps()) {
    if (!known_.insert({pair.a, pair.b}).second) continue;
    notes.push_back(
        fmt::format("{} when they have come to share functions of the grid, which push them apart, or hold "
                    "them together, before they touch; expected smaller cells where they meet",
                    apart(pair)));
  }
  return notes;
}

std::vector<std::string> notes_on_jumps(const Scene& scene, const std::vector<WallReaction>& walls) {
  constexpr double far = 0.05;  // of a cell
  std::vector<std::string> notes;
  for (const WallReaction& wall : walls) {
    const double cells = wall.put_back / scene.grid.cell_length(static_cast<std::size_t>(wall.axis));
    if (!(cells > far)) continue;
    notes.push_back(
        fmt::format("the wall '{}' moved a node by {:.4g} m ({:.2g} cells) at once: points that jump so far "
                    "keep stresses that no function of the grid feels; expected initial values outside the "
                    "wall, and a motion of the wall that takes some time",
                    wall.name, wall.put_back, cells));
  }
  return notes;
}

}  // namespace stillpoint
