#include "simulation/rigid_figures.hpp"

#include <algorithm>
#include <iterator>

#include "base/text.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

bool has_moments(const Problem& problem) { return problem.state != StressState::axisymmetric; }

}  // namespace

std::vector<std::string> rigid_columns(const Problem& problem) {
  std::vector<std::string> columns;
  const std::vector<std::string> axes = axis_names(problem.dim);
  for (const RigidSpec& rigid : problem.rigid) {
    std::ranges::move(component_names(rigid.name + ".force", axes, "_"), std::back_inserter(columns));
    if (has_moments(problem) && problem.dim == 3)
      std::ranges::move(component_names(rigid.name + ".moment", axes, "_"), std::back_inserter(columns));
    if (has_moments(problem) && problem.dim == 2) columns.push_back(rigid.name + ".moment_z");
    columns.push_back(rigid.name + ".contact_area");
    columns.push_back(rigid.name + ".penetration");
    if (rigid.friction > 0) columns.push_back(rigid.name + ".slipping");
  }
  return columns;
}

std::vector<double> rigid_values(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  std::vector<double> values;
  if (problem.rigid.empty()) return values;
  const std::vector<RigidReport> reports = phase.supports().rigid_bodies(t, u);
  for (std::size_t k = 0; k < problem.rigid.size(); ++k) {
    const RigidReport& report = reports[k];
    values.insert(values.end(), report.force.begin(), report.force.begin() + problem.dim);
    if (has_moments(problem))
      values.insert(values.end(), report.moment.begin() + (problem.dim == 3 ? 0 : 2), report.moment.end());
    values.insert(values.end(), {report.area, report.penetration});
    if (problem.rigid[k].friction > 0) values.push_back(report.slipping);
  }
  return values;
}

void fill_rigid(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, Summary& summary) {
  const std::vector<std::string> columns = rigid_columns(problem);
  const std::vector<double> values = rigid_values(problem, phase, t, u);
  for (std::size_t k = 0; k < columns.size(); ++k) summary.contacts[columns[k]] = values[k];
}

}  // namespace stillpoint
