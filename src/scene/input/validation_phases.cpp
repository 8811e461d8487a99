// When phases end, and what scenes of more than one phase can have.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/phase_choices.hpp"
#include "scene/support_kind.hpp"

namespace stillpoint {
namespace {

/// A wall that moves, or does not stand on its face, is on a grid line only if the grid follows it.
void check_moving_walls(SceneCheck& check, const std::string& one_phase) {
  const Scene& scene = check.scene();
  const std::string& follow = scene.grid.follow;
  // Whom the grid follows has to be put right first.
  if (!follow.empty() && std::ranges::find(scene.walls, follow, &WallSpec::name) == scene.walls.end()) return;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const WallSpec& wall = scene.walls[k];
    const bool rests = wall.motion.constant() && wall.motion({}, 0) == 0;
    if (rests || wall.name.empty() || follow == wall.name) continue;
    check.add(
        fmt::format("wall[{}].motion", k),
        fmt::format("a wall that moves has to stay on a grid line from phase to phase{}, {}",
                    follow.empty() ? fmt::format(": give grid.follow = {}", in_quotes(wall.name))
                                   : fmt::format(", but the grid follows {}: let this one rest", in_quotes(follow)),
                    one_phase));
  }
}

/// A support that prescribes unknowns holds what is at its node or at its face of the grid: what moves with it leaves
/// them.
void check_moving_supports(SceneCheck& check, bool grid, const std::string& one_phase) {
  const Scene& scene = check.scene();
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const SupportSpec& support = scene.supports[k];
    if (support.motion.constant() && support.motion({}, 0) == 0) continue;
    if (!grid || scene.grid.cells.empty() || holds_by_springs(scene.grid, support))
      continue;  // the springs go with the material
    check.add(
        fmt::format("support[{}].u", k),
        fmt::format("the material that moves with this support leaves its {} from phase to phase; {}, give a "
                    "stiffness, by which springs hold the material, {}",
                    support.face ? "face of the grid" : "node",
                    support.face ? "take a [[wall]] with a motion that the grid follows" : "let it rest", one_phase));
  }
}

/// A mean dilatation is one of the displacement since the phase began.
void check_dilatation(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (scene.phase.dilatation == Dilatation::points) return;
  if (scene.state == StressState::plane_stress)
    check.add("phase.dilatation",
              "in plane stress the thickness is free to change, and nothing locks; take \"points\"");
  if (scene.phase.deformation.is_asked() && scene.phase.deformation == DeformationRule::positions)
    check.add("phase.deformation",
              "a mean dilatation is carried on from phase to phase, which positions do not know; take "
              "\"accumulated\", or phase.dilatation = \"points\"");
}

}  // namespace

void check_phases(SceneCheck& check, bool grid) {
  const Scene& scene = check.scene();
  const PhaseSpec& phase = scene.phase;
  check_dilatation(check);
  const bool known = check.sound("phase.transfer");
  if (known && phase.transfer != Transfer::flip)
    check.refuse("phase", {"flip_share"}, "goes with transfer = \"flip\" only");
  if (known && phase.transfer != Transfer::xpic)
    check.refuse("phase", {"xpic_order"}, "goes with transfer = \"xpic\" only");
  if (scene.solve.is_static()) {
    const std::string why = fmt::format("'{}' is a static solver, which needs a single phase: ", scene.solve.method);
    if (phase.ends_by_motion()) check.add("phase.max_motion", why + "take \"none\"");
    if (phase.max_strain) check.add("phase.max_strain", why + "leave this out");
    return;
  }
  if (!phase.ends())
    return check.refuse("phase", {"deformation", "quadrature"}, "goes with phases only: give phase.max_motion");
  const auto materials = materials_in_use(scene, check.catalogue());
  // The key that asks for phases; a history brings them unasked.
  const bool unasked = !phase.max_motion.is_asked() && !phase.max_strain;
  const std::string asked = !phase.max_motion.is_asked() && phase.max_strain ? "phase.max_strain" : "phase.max_motion";
  if (any_remembers(materials, check.catalogue()))
    check.refuse("phase", {"deformation"},
                 "goes with laws without history only, whose stress follows from the deformation");
  if (const std::string why_not = why_no_domains(scene); phase.quadrature == Quadrature::domains && !why_not.empty())
    check.add("phase.quadrature", fmt::format("{}: there are no domains side by side; take \"points\"", why_not));

  const std::string one_phase = fmt::format(
      "or {}{}{} for a single phase", phase.ends_by_motion() ? "phase.max_motion = \"none\"" : "",
      phase.ends_by_motion() && phase.max_strain ? " and " : "", phase.max_strain ? "no phase.max_strain" : "");
  for (const MaterialSpec* material : materials) {
    if (law_of(check, *material)->finite_strain) continue;
    const std::string law = fmt::format("material.{}.law", material->name);
    check.add(unasked ? law : asked,
              fmt::format("'{}' is a law of small strain, whose positions never change, so that no phase ends; take "
                          "hencky or neo-hookean, {}",
                          material->law, one_phase));
    return;  // the rest is not worth putting right
  }
  if (scene.grid.basis == BasisKind::hermite) {
    check.add("grid.basis", fmt::format("'hermite' has no lumped mass to carry velocities from phase to phase; take "
                                        "linear, quadratic or cubic, {}",
                                        one_phase));
  } else if (scene.mass.kind == MassKind::consistent) {
    check.add(
        scene.mass.kind.is_asked() ? "mass.kind" : asked,
        fmt::format("velocities are carried from phase to phase by a lumped mass; take mass.kind = \"lumped\", {}",
                    one_phase));
  }
  if (scene.exact.known())
    check.add(scene.exact.solution.empty() ? "exact.u" : "exact.solution",
              fmt::format("is a function of undeformed positions, which later phases do not know; leave it out, {}",
                          one_phase));
  if (scene.stop.distance > 0)
    check.add("stop.distance", fmt::format("is certified for one set of unknowns, not from phase to phase; take "
                                           "stop.residual, {}",
                                           one_phase));
  check_moving_supports(check, grid, one_phase);
  check_moving_walls(check, one_phase);
}

}  // namespace stillpoint
