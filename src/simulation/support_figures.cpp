#include "simulation/support_figures.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/text.hpp"
#include "output/point_fields.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

// Those of all stages: one that does not hold bears nothing.
std::vector<std::string> names_of_supports(const Problem& problem) {
  if (problem.phase.at_stages) return problem.named_supports;
  std::vector<std::string> names;
  for (const SupportSpec& support : problem.supports)
    if (!support.name.empty()) names.push_back(support.name);
  return names;
}

int moment_components(const Problem& problem) { return dimension_info(problem.dim).moment_components; }

double largest_displacement(const LagrangianPhase& phase, double t, ConstVec u) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  std::vector<double> of_points(dim * phase.points());
  phase.fields().point_displacement(t, u, of_points);
  double largest = 0;
  for (const double length : lengths_of(of_points, dim)) largest = std::max(largest, length);
  return largest;
}

// A stiffness that the scene gives is meant to give way.
std::string note_on_gap(const SupportGap& weak, const SupportSpec& support) {
  constexpr double negligible_share = 0.01;
  if (support.stiffness || !(weak.share > negligible_share)) return "";
  const std::string name =
      support.name.empty() ? weak.support : fmt::format("{} {}", weak.support, in_quotes(support.name));
  return fmt::format(
      "{} gives way by {:.3g} m, {:.2g} of the largest displacement: springs hold it, as the basis has no value of its "
      "own there; expected {}, or a stiffness above {:.3g} {}, with which steps are shorter",
      name, weak.gap, weak.share, support.face ? "smaller cells" : "a part of a face, not a position", weak.stiffness,
      support.face ? "N/m3" : "N/m");
}

}  // namespace

std::vector<std::string> reaction_columns(const Problem& problem) {
  std::vector<std::string> columns;
  for (const std::string& name : names_of_supports(problem)) {
    std::vector<std::string> axes = axis_names(problem.dim);
    std::ranges::move(component_names(name + ".reaction", axes, "_"), std::back_inserter(columns));
    axes.resize(static_cast<std::size_t>(moment_components(problem)));
    std::ranges::move(component_names(name + ".moment", axes, "_"), std::back_inserter(columns));
  }
  return columns;
}

std::vector<double> reaction_values(const Problem& problem, const LagrangianPhase& phase, double t,
                                    PhaseMotion& motion) {
  std::vector<double> values;
  const std::vector<std::string> names = names_of_supports(problem);
  if (names.empty()) return values;
  const std::vector<SupportReaction> reactions =
      phase.supports().support_reactions(t, motion.u(), motion.system.last().trial->reactions);
  for (const std::string& name : names) {
    const auto found = std::ranges::find(reactions, name, &SupportReaction::name);
    const SupportReaction support = found == reactions.end() ? SupportReaction{name, {}} : *found;
    values.insert(values.end(), support.force.begin(), support.force.begin() + problem.dim);
    values.insert(values.end(), support.moment.begin(), support.moment.begin() + moment_components(problem));
  }
  return values;
}

void fill_supports(const Problem& problem, const LagrangianPhase& phase, double t, PhaseMotion& motion,
                   Summary& summary) {
  if (!names_of_supports(problem).empty()) {
    motion.residual(t);
    for (const SupportReaction& support :
         phase.supports().support_reactions(t, motion.u(), motion.system.last().trial->reactions)) {
      summary.reactions[support.name] = {support.force.begin(), support.force.begin() + problem.dim};
      if (const int moments = moment_components(problem); moments > 0)
        summary.reaction_moments[support.name] = {support.moment.begin(), support.moment.begin() + moments};
    }
  }
  const std::vector<WeakSupport> weak = phase.supports().weak_supports(t, motion.u());
  const double largest = weak.empty() ? 0 : largest_displacement(phase, t, motion.u());
  for (const WeakSupport& one : weak) {
    const SupportSpec& support = problem.supports[one.support];
    const SupportGap& gap =
        summary.weak_supports.emplace_back(SupportGap{.support = fmt::format("support[{}]", one.support),
                                                      .stiffness = one.stiffness,
                                                      .gap = one.gap,
                                                      .share = largest > 0 ? one.gap / largest : 0});
    if (std::string note = note_on_gap(gap, support); !note.empty()) summary.notes.push_back(std::move(note));
  }
}

}  // namespace stillpoint
