#include "simulation/motion_figures.hpp"

#include <cstddef>

#include "base/text.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

/// Calls take(column, formula) for each.
template <class Take>
void for_each_motion(const Problem& problem, const Take& take) {
  const auto named = [&](const std::string& name, std::size_t axis) {
    return component_names(name + ".motion", axis_names(problem.dim), "_")[axis];
  };
  const auto drives = [](const Expression& motion) { return motion.uses('t') && !motion.uses_position(); };
  for (const WallSpec& wall : problem.walls)
    if (!wall.name.empty() && drives(wall.motion)) take(wall.name + ".motion", wall.motion);
  for (const RigidSpec& rigid : problem.phase.at_stages ? problem.rigid_as_written : problem.rigid) {
    for (std::size_t axis = 0; axis < rigid.motion.size(); ++axis)
      if (drives(rigid.motion[axis])) take(named(rigid.name, axis), rigid.motion[axis]);
  }
  if (problem.phase.at_stages) return;
  for (const SupportSpec& support : problem.supports)
    if (!support.name.empty() && drives(support.motion))
      take(named(support.name, static_cast<std::size_t>(support.component.value())), support.motion);
}

}  // namespace

std::vector<std::string> motion_columns(const Problem& problem) {
  std::vector<std::string> columns;
  for_each_motion(problem, [&](const std::string& column, const Expression&) { columns.push_back(column); });
  return columns;
}

std::vector<double> motion_values(const Problem& problem, double t) {
  std::vector<double> values;
  for_each_motion(problem, [&](const std::string&, const Expression& motion) { values.push_back(motion({}, t)); });
  return values;
}

}  // namespace stillpoint
