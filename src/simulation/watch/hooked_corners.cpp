// Rigid bodies that are held across a border. Contact is felt at the pieces of a border. A corner that has sunk in by
// less than a cell has one piece beside it, which its side pushes along the border: the smooth border of the material
// would not bear that, and a body that should slide would rest behind each piece that it comes to. A round body that
// touches no more than a cell is held likewise in between two pieces.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/rigid_body.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

/// A half-plane is the same wherever it slides: no place of a border holds it.
bool is_alike_along_itself(const RigidSpec& rigid) { return !rigid.half_plane.empty(); }

/// A rigid body that is free or driven, and that a corner bears by more than this share of its force where friction
/// does not; empty: there is none.
struct Hooked {
  const RigidSpec* rigid;
  double share;  // of its force
};
std::optional<Hooked> find_hooked(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, bool free,
                                  double least) {
  const std::vector<ContactReport> reports = phase.supports().contacts(t, u);
  for (std::size_t r = 0; r < problem.rigid.size(); ++r) {
    const auto& [x, y, z] = reports[r].force;
    const double force = std::hypot(x, y, z), hooked = reports[r].hooked;
    const bool slides = free && is_alike_along_itself(problem.rigid[r]);
    if (problem.rigid[r].free == free && !slides && hooked > std::max(least * force, reports[r].shear_left))
      return Hooked{&problem.rigid[r], hooked / force};
  }
  return {};
}

/// A free rigid body that would slide if no corner held it.
std::string fault_of_corners(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  constexpr double little = 1e-3;
  const auto found = find_hooked(problem, phase, t, u, /*free=*/true, little);
  if (!found) return "";
  return fmt::format(
      "{} is held by a sharp corner, which stands behind a place of the border that feels contact: {:.2g} of the "
      "force on it acts along that border, and without it the body slides, as friction and adhesion do not bear as "
      "much; "
      "expected a rounding of half a cell, or smaller cells",
      in_quotes(found->rigid->name), found->share);
}

/// A free rigid body that would slide if the border bore what pushes it along its own normals alone. What a border that
/// goes around it bears in between its pieces is less than that, as are the tilts of its cells.
std::string fault_across(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  constexpr double little = 5e-3;
  const std::vector<ContactReport> reports = phase.supports().contacts(t, u);
  for (std::size_t r = 0; r < problem.rigid.size(); ++r) {
    const auto& [x, y, z] = reports[r].force;
    const double force = std::hypot(x, y, z), across = reports[r].across;
    if (!problem.rigid[r].free || is_alike_along_itself(problem.rigid[r]) ||
        !(across > std::max(little * force, reports[r].shear_left)))
      continue;
    return fmt::format(
        "{} is held in between the few places of a border that feel contact with it: {:.2g} of the force on it acts "
        "across the normals of that border, which bears nothing there if it is smooth, and without it the body slides, "
        "as friction and adhesion do not bear as much; expected friction, a load that points to the border, or smaller "
        "cells",
        in_quotes(problem.rigid[r].name), across / force);
  }
  return "";
}

/// A driven one, which goes where it is told to go all the same, with another force.
std::string corner_of_driven(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  constexpr double noted = 0.01;
  const auto found = find_hooked(problem, phase, t, u, /*free=*/false, noted);
  if (!found) return "";
  const std::string name = in_quotes(found->rigid->name);
  if (corners_of(*found->rigid).empty())
    return fmt::format(
        "{}, which has no corner, pushes places of a border that feel contact along that border, as beside a corner of "
        "the body that is pressed in or where it is narrower than a cell: {:.2g} of its force, which may be off by as "
        "much; expected smaller cells there",
        name, found->share);
  return fmt::format(
      "a sharp corner of {} pushes the places of a border that feel contact along that border, as the border of the "
      "material would not be: {:.2g} of its force; expected a rounding of half a cell, or smaller cells",
      name, found->share);
}

class HookedCorners : public Watcher {
 public:
  void confirm(RunState& run, Verdict& verdict) override {
    if (const std::string fault = look(run); !fault.empty())
      verdict = {RunStatus::step_limit, fmt::format("no equilibrium: {}; it ended with {}", fault, verdict.reason)};
  }
  void fill_state(Summary& summary, RunState& run) override {
    if (run.scene.stop.wants_equilibrium()) add_note(summary, look(run));
    if (!run.scene.rigid.empty())
      add_note(summary, corner_of_driven(run.scene, *run.model.phase, run.t, run.motion->u()));
  }

 private:
  static std::string look(RunState& run) {
    if (std::ranges::none_of(run.scene.rigid, &RigidSpec::free)) return "";
    const LagrangianPhase& phase = *run.model.phase;
    const std::string fault = fault_of_corners(run.scene, phase, run.t, run.motion->u());
    return fault.empty() ? fault_across(run.scene, phase, run.t, run.motion->u()) : fault;
  }
};

}  // namespace

std::unique_ptr<Watcher> watch_hooked_corners() { return std::make_unique<HookedCorners>(); }

}  // namespace stillpoint
