#include <algorithm>
#include <set>
#include <string_view>

#include "scene/resolve.hpp"
#include "scene/stages.hpp"

namespace stillpoint {
namespace {

constexpr double motion_with_history = 0.1;  // phase.max_motion of a law with a history, as a share of a cell

bool damps(const Problem& problem, const Catalogue& catalogue) {
  const StrategyInfo* const strategy = catalogue.strategy(problem.damping.strategy);
  return strategy && strategy->damps;
}

/// Whether a material of bodies that come later, or that a stage gives to some, remembers.
bool some_stage_remembers(const Problem& problem, const Catalogue& catalogue) {
  const auto remembers = [&](const std::string& material) {
    const auto found = problem.materials.find(material);
    const LawInfo* const law = found == problem.materials.end() ? nullptr : catalogue.law(found->second.law);
    return law && law->history_dependent;
  };
  return std::ranges::any_of(problem.later_bodies, remembers, &BodySpec::material) ||
         std::ranges::any_of(problem.stages,
                             [&](const StageSpec& stage) { return std::ranges::any_of(stage.material, remembers); });
}

// Bodies whose law has no history take domains if they can, if each point keeps its own change of volume, and if the
// motion is damped: without damping, means over domains would cost flip some of the motion's energy. With damping they
// take apic: flip keeps the part of the points' velocities that no function of this phase sees until functions of a
// later phase see it, and that shakes a body that overshoots into a shape that no force takes back. What is chosen
// holds for all stages.
void resolve_quadrature(Problem& problem, const Catalogue& catalogue, bool remembers) {
  PhaseSpec& phase = problem.phase;
  const bool moves_on = phase.ends_by_motion() || phase.max_strain;  // and does so not by stages alone
  const bool rests = damps(problem, catalogue) && problem.grid.basis != BasisKind::hermite && !remembers && moves_on &&
                     !some_stage_remembers(problem, catalogue) && !problem.displacements_from_zero;
  if (rests && phase.dilatation == Dilatation::points && why_no_domains(problem).empty()) {
    phase.quadrature.take(Quadrature::domains, "the points of elastic boxes, damped, lie side by side");
  } else {
    phase.quadrature.take(Quadrature::points);
  }
  if (rests && phase.quadrature == Quadrature::domains && !phase.flip_share.is_asked()) {
    phase.transfer.take(Transfer::apic, "domains, damped");
  } else {
    phase.transfer.take(Transfer::flip);
  }
}

}  // namespace

std::vector<const MaterialSpec*> materials_in_use(const Problem& problem, const Catalogue& catalogue) {
  std::vector<const MaterialSpec*> materials;
  std::set<std::string_view> seen;
  for (const BodySpec& body : problem.bodies) {
    if (!seen.insert(body.material).second) continue;
    const auto found = problem.materials.find(body.material);
    const LawInfo* const law = found == problem.materials.end() ? nullptr : catalogue.law(found->second.law);
    if (!law || std::ranges::find(law->states, problem.state) == law->states.end()) continue;
    materials.push_back(&found->second);
  }
  return materials;
}

bool any_remembers(const std::vector<const MaterialSpec*>& materials, const Catalogue& catalogue) {
  return std::ranges::any_of(materials,
                             [&](const MaterialSpec* one) { return catalogue.law(one->law)->history_dependent; });
}

std::string why_no_domains(const Problem& problem) {
  if (problem.state == StressState::axisymmetric) return "an axisymmetric scene has rings";
  if (problem.state == StressState::space) return "in space points stand for themselves";
  for (const BodySpec& body : bodies_of_all_stages(problem)) {
    if (!body.is_box()) return "a body of a file or a polygon is no box";
    if (body.placement != Placement::uniform || body.jitter > 0) return "points that are not uniform share no faces";
  }
  return "";
}

void resolve_phases(Problem& problem, const Catalogue& catalogue) {
  PhaseSpec& phase = problem.phase;
  const bool remembers = any_remembers(materials_in_use(problem, catalogue), catalogue);
  if (remembers && !problem.solve.is_static()) {
    phase.max_motion.take(motion_with_history, "a law remembers");
  } else {
    phase.max_motion.take(PhaseSpec::never);
  }
  if ((problem.solve.is_static() && !phase.at_stages) || !phase.ends()) {
    phase.quadrature.take(Quadrature::points);
    phase.transfer.take(Transfer::flip);
    phase.deformation.take(DeformationRule::positions);
    return;
  }
  resolve_quadrature(problem, catalogue, remembers);
  // A strain that jumps at grid lines would feed the motion, and a mean dilatation is carried on.
  const bool jumps = problem.grid.basis == BasisKind::linear && phase.quadrature == Quadrature::points;
  if (jumps || phase.dilatation != Dilatation::points) {
    phase.deformation.take(DeformationRule::accumulated, "strains jump at grid lines, or dilatation is a mean");
  } else {
    phase.deformation.take(DeformationRule::positions);
  }
}

}  // namespace stillpoint
