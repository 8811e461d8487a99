// Checks of [phase], and of what scenes of more than one phase cannot have.
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/resolve.hpp"

namespace stillpoint {
namespace {

/// How a scene does without phases.
std::string for_one_phase(const PhaseSpec& phase) {
  if (phase.at_stages) return "or leave out [[stage]] and initial.from";
  const bool by_motion = phase.ends_by_motion(), by_strain = phase.max_strain.has_value();
  return fmt::format("or {}{}{} for a single phase", by_motion ? "phase.max_motion = \"none\"" : "",
                     by_motion && by_strain ? " and " : "", by_strain ? "no phase.max_strain" : "");
}

/// A wall that moves, or does not stand on its face, is on a grid line only if the grid follows it.
void check_moving_walls(SceneCheck& check, const std::string& one_phase) {
  const Scene& scene = check.scene();
  const std::string& follow = scene.grid.follow;
  // The wall that the grid follows has to be put right first.
  if (!follow.empty() && std::ranges::find(scene.walls, follow, &WallSpec::name) == scene.walls.end()) return;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const WallSpec& wall = scene.walls[k];
    check.wrong_if(!rests(wall.motion) && !wall.name.empty() && follow != wall.name, fmt::format("wall[{}].motion", k),
                   "a wall that moves has to stay on a grid line from phase to phase{}, {}",
                   follow.empty() ? fmt::format(": give grid.follow = {}", in_quotes(wall.name))
                                  : fmt::format(", but the grid follows {}: let this one rest", in_quotes(follow)),
                   one_phase);
  }
}

/// A support that prescribes unknowns holds what is at its node or at its face of the grid; the material that moves
/// with it leaves them. Springs go with the material.
void check_moving_supports(SceneCheck& check, const std::string& one_phase) {
  const Scene& scene = check.scene();
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    const SupportSpec& support = scene.supports[k];
    check.wrong_if(!rests(support.motion) && !holds_by_springs(scene.grid, support), fmt::format("support[{}].u", k),
                   "the material that moves with this support leaves its {} from phase to phase; {}, give a stiffness, "
                   "by which springs hold the material, {}",
                   support.face ? "face of the grid" : "node",
                   support.face ? "take a [[wall]] with a motion that the grid follows" : "let it rest", one_phase);
  }
}

/// Checks the keys that do not depend on whether phases end.
void check_keys_of_phases(SceneCheck& check) {
  const Scene& scene = check.scene();
  const PhaseSpec& phase = scene.phase;
  const bool of_points = phase.dilatation == Dilatation::points, known = check.sound("phase.transfer");
  check.wrong_if(!of_points && scene.state == StressState::plane_stress, "phase.dilatation",
                 "in plane stress the thickness is free to change, and nothing locks; take \"points\"");
  check.wrong_if(
      !of_points && phase.deformation.is_asked() && phase.deformation == DeformationRule::positions,
      "phase.deformation",
      "a mean dilatation is carried on from phase to phase, which positions do not know; take \"accumulated\", or "
      "phase.dilatation = \"points\"");
  check.refuse_if(known && phase.transfer != Transfer::flip, "phase", {"flip_share"},
                  "goes with transfer = \"flip\" only");
  check.refuse_if(known && phase.transfer != Transfer::xpic, "phase", {"xpic_order"},
                  "goes with transfer = \"xpic\" only");
}

void check_single_phase(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (!scene.solve.is_static())
    return check.refuse_if(true, "phase", {"deformation", "quadrature"},
                           "goes with phases only: give phase.max_motion");
  constexpr const char* why = "'{}' is a static solver, which needs a single phase: {}";
  check.wrong_if(scene.phase.ends_by_motion(), "phase.max_motion", why, scene.solve.method, "take \"none\"");
  check.wrong_if(scene.phase.max_strain.has_value(), "phase.max_strain", why, scene.solve.method, "leave this out");
}

}  // namespace

void check_phases(SceneCheck& check, bool grid) {
  const Scene& scene = check.scene();
  const PhaseSpec& phase = scene.phase;
  check_keys_of_phases(check);
  if (scene.solve.is_static() || !phase.ends()) check_single_phase(check);
  if ((scene.solve.is_static() && !phase.at_stages) || !phase.ends()) return;
  const auto materials = materials_in_use(scene, check.catalogue());
  // The key that asks for phases; a history brings them unasked.
  const bool by_motion = phase.max_motion.is_asked() || !phase.max_strain;
  const std::string asked = phase.at_stages ? (scene.initial_from.empty() ? "stage[0]" : "initial.from")
                            : by_motion     ? "phase.max_motion"
                                            : "phase.max_strain";
  check.refuse_if(any_remembers(materials, check.catalogue()), "phase", {"deformation"},
                  "goes with laws without history only, whose stress follows from the deformation");
  const std::string why_not = why_no_domains(scene), one_phase = for_one_phase(phase);
  check.wrong_if(phase.quadrature == Quadrature::domains && !why_not.empty(), "phase.quadrature",
                 "{}: there are no domains side by side; take \"points\"", why_not);
  // Domains reach into cells with which they share nothing. A block that is pressed by 17 % found another rest, at 26
  // %.
  check.wrong_if(phase.quadrature == Quadrature::domains && phase.dilatation != Dilatation::points, "phase.quadrature",
                 "domains reach beyond the cells whose points share their change of volume, and once they have moved "
                 "nothing resists some shapes; take \"points\", or phase.dilatation = \"points\"");
  const auto is_finite = [&](const MaterialSpec* one) { return check.catalogue().law(one->law)->finite_strain; };
  // At the end of a stage such laws keep their strains; beside others, whose points move, they cannot.
  const bool stays_in_place =
      phase.at_stages && !phase.ends_by_motion() && !phase.max_strain && std::ranges::none_of(materials, is_finite);
  for (const MaterialSpec* material : materials) {
    if (stays_in_place) break;
    const bool unasked = !phase.max_motion.is_asked() && !phase.max_strain && !phase.at_stages;
    if (check.wrong_if(!is_finite(material), unasked ? fmt::format("material.{}.law", material->name) : asked,
                       "'{}' is a law of small strain, whose positions never change, so that no phase ends; take "
                       "hencky or neo-hookean, {}",
                       material->law, one_phase))
      return;  // the rest is not worth putting right
  }
  const bool hermite = scene.grid.basis == BasisKind::hermite;
  check.wrong_if(hermite, "grid.basis",
                 "'hermite' has no lumped mass to carry velocities from phase to phase; take linear, quadratic or "
                 "cubic, {}",
                 one_phase);
  check.wrong_if(!hermite && scene.mass.kind == MassKind::consistent, scene.mass.kind.is_asked() ? "mass.kind" : asked,
                 "velocities are carried from phase to phase by a lumped mass; take mass.kind = \"lumped\", {}",
                 one_phase);
  check.wrong_if(scene.exact.known(), scene.exact.solution.empty() ? "exact.u" : "exact.solution",
                 "is a function of undeformed positions, which later phases do not know; leave it out, {}", one_phase);
  check.wrong_if(scene.stop.distance > 0, "stop.distance",
                 "is certified for one set of unknowns, not from phase to phase; take stop.residual, {}", one_phase);
  if (grid && !scene.grid.cells.empty()) check_moving_supports(check, one_phase);
  check_moving_walls(check, one_phase);
}

}  // namespace stillpoint
