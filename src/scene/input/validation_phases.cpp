// When phases end, and what scenes of more than one phase can have.
#include <algorithm>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/support_kind.hpp"

namespace stillpoint {
namespace {

/// The materials of the bodies, each once; without those whose law is not for this scene, which has been said.
std::vector<const MaterialSpec*> materials_in_use(SceneCheck& check) {
  const Scene& scene = check.scene();
  std::vector<const MaterialSpec*> materials;
  std::set<std::string_view> seen;
  for (const BodySpec& body : scene.bodies) {
    if (!seen.insert(body.material).second) continue;
    const auto found = scene.materials.find(body.material);
    const LawInfo* const law = found == scene.materials.end() ? nullptr : law_of(check, found->second);
    if (!law || std::ranges::find(law->states, scene.state) == law->states.end()) continue;
    materials.push_back(&found->second);
  }
  return materials;
}

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

/// Domains lie side by side in boxes that uniform points fill.
std::string why_no_domains(const Scene& scene) {
  if (scene.state == StressState::axisymmetric) return "an axisymmetric scene has rings";
  if (scene.state == StressState::space) return "in space points stand for themselves";
  for (const BodySpec& body : scene.bodies) {
    if (!body.is_box()) return "a body of a file or a polygon is no box";
    if (body.placement != Placement::uniform || body.jitter > 0) return "points that are not uniform share no faces";
  }
  return "";
}

/// Elastic bodies take domains where there are some, but where nothing damps: means over domains cost flip some of the
/// motion's energy.
void choose_quadrature(SceneCheck& check, bool remembers) {
  Scene& scene = check.scene();
  const std::string why_not = why_no_domains(scene);
  const StrategyInfo* const strategy = check.catalogue().strategy(scene.damping.strategy);
  const bool rests = strategy && strategy->damps && scene.grid.basis != BasisKind::hermite && !remembers;
  if (!check.written("phase.quadrature")) {
    scene.phase.quadrature = rests && why_not.empty() ? Quadrature::domains : Quadrature::points;
  } else if (scene.phase.quadrature == Quadrature::domains && !why_not.empty()) {
    check.add("phase.quadrature", fmt::format("{}: there are no domains side by side; take \"points\"", why_not));
  }
  // What of the points' velocities no function feels, flip keeps until the functions of a later phase do: that shakes a
  // body that overshoots into a shape that no force takes back.
  const bool says_how = check.written("phase.transfer") || check.written("phase.flip_share");
  if (rests && scene.phase.quadrature == Quadrature::domains && !says_how) scene.phase.transfer = Transfer::apic;
}

/// A mean dilatation is one of the displacement since the phase began.
void check_dilatation(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (scene.phase.dilatation == Dilatation::points) return;
  if (scene.state == StressState::plane_stress)
    check.add("phase.dilatation",
              "in plane stress the thickness is free to change, and nothing locks; take \"points\"");
  if (check.written("phase.deformation") && scene.phase.deformation == DeformationRule::positions)
    check.add("phase.deformation",
              "a mean dilatation is carried on from phase to phase, which positions do not know; take "
              "\"accumulated\", or phase.dilatation = \"points\"");
}

}  // namespace

void check_phases(SceneCheck& check, bool grid) {
  Scene& scene = check.scene();
  PhaseSpec& phase = scene.phase;
  check_dilatation(check);
  const bool known = check.sound("phase.transfer");
  if (known && phase.transfer != Transfer::flip)
    check.refuse("phase", {"flip_share"}, "goes with transfer = \"flip\" only");
  if (known && phase.transfer != Transfer::xpic)
    check.refuse("phase", {"xpic_order"}, "goes with transfer = \"xpic\" only");
  if (scene.solve.is_static()) {
    const std::string why = fmt::format("'{}' is a static solver, which needs a single phase: ", scene.solve.method);
    if (phase.max_motion) check.add("phase.max_motion", why + "take \"none\"");
    if (phase.max_strain) check.add("phase.max_strain", why + "leave this out");
    return;
  }
  const auto materials = materials_in_use(check);
  // The key that asks for phases; a history brings them unasked.
  std::string asked = "phase.max_motion";
  if (!check.written(asked) && phase.max_strain) asked = "phase.max_strain";
  const bool unasked = !check.written(asked);
  constexpr double usual_motion = 0.1;
  if (!check.written("phase.max_motion") &&
      std::ranges::any_of(materials, [&](const MaterialSpec* m) { return law_of(check, *m)->history_dependent; }))
    phase.max_motion = usual_motion;
  if (!phase.max_motion && !phase.max_strain)
    return check.refuse("phase", {"deformation", "quadrature"}, "goes with phases only: give phase.max_motion");
  const bool remembers =
      std::ranges::any_of(materials, [&](const MaterialSpec* m) { return law_of(check, *m)->history_dependent; });
  if (remembers)
    check.refuse("phase", {"deformation"},
                 "goes with laws without history only, whose stress follows from the deformation");
  choose_quadrature(check, remembers);
  const bool jumps = scene.grid.basis == BasisKind::linear && phase.quadrature == Quadrature::points;
  // A strain that jumps at grid lines would feed the motion.
  if (!check.written("phase.deformation") && (jumps || phase.dilatation != Dilatation::points))
    phase.deformation = DeformationRule::accumulated;

  const std::string one_phase =
      fmt::format("or {}{}{} for a single phase", phase.max_motion ? "phase.max_motion = \"none\"" : "",
                  phase.max_motion && phase.max_strain ? " and " : "", phase.max_strain ? "no phase.max_strain" : "");
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
        check.written("mass.kind") ? "mass.kind" : asked,
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
