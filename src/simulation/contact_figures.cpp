#include "simulation/contact_figures.hpp"

#include <algorithm>
#include <iterator>

#include "base/text.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

bool has_moments(const Problem& problem) { return problem.state != StressState::axisymmetric; }

struct TouchingPair {
  std::string name;
  bool rubs, is_free;
};

/// Those of all stages: what is not there bears nothing.
std::vector<TouchingPair> touching_pairs(const Problem& problem) {
  std::vector<TouchingPair> pairs;
  for (const RigidSpec& rigid : problem.phase.at_stages ? problem.rigid_as_written : problem.rigid)
    pairs.push_back({rigid.name, rigid.shear.acts(), rigid.free});
  for (const ContactSpec& contact : problem.contacts) pairs.push_back({contact.name(), contact.shear.acts(), false});
  return pairs;
}

}  // namespace

std::vector<std::string> contact_columns(const Problem& problem) {
  std::vector<std::string> columns;
  const std::vector<std::string> axes = axis_names(problem.dim);
  for (const auto& [name, rubs, is_free] : touching_pairs(problem)) {
    std::ranges::move(component_names(name + ".force", axes, "_"), std::back_inserter(columns));
    if (has_moments(problem) && problem.dim == 3)
      std::ranges::move(component_names(name + ".moment", axes, "_"), std::back_inserter(columns));
    if (has_moments(problem) && problem.dim == 2) columns.push_back(name + ".moment_z");
    columns.push_back(name + ".contact_area");
    columns.push_back(name + ".penetration");
    if (rubs) columns.push_back(name + ".slipping");
    if (is_free) std::ranges::move(component_names(name + ".displacement", axes, "_"), std::back_inserter(columns));
  }
  return columns;
}

std::vector<double> contact_values(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  std::vector<double> values;
  const std::vector<TouchingPair> pairs = touching_pairs(problem);
  if (pairs.empty()) return values;
  const std::vector<ContactReport> reports = phase.supports().contacts(t, u);
  for (const TouchingPair& pair : pairs) {
    const auto found = std::ranges::find(reports, pair.name, &ContactReport::name);
    const ContactReport report = found == reports.end() ? ContactReport{} : *found;
    values.insert(values.end(), report.force.begin(), report.force.begin() + problem.dim);
    if (has_moments(problem))
      values.insert(values.end(), report.moment.begin() + (problem.dim == 3 ? 0 : 2), report.moment.end());
    values.insert(values.end(), {report.area, report.penetration});
    if (pair.rubs) values.push_back(report.slipping);
    if (pair.is_free)
      values.insert(values.end(), report.displacement.begin(), report.displacement.begin() + problem.dim);
  }
  return values;
}

void fill_contacts(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u, Summary& summary) {
  const std::vector<std::string> columns = contact_columns(problem);
  const std::vector<double> values = contact_values(problem, phase, t, u);
  for (std::size_t k = 0; k < columns.size(); ++k) summary.contacts[columns[k]] = values[k];
}

}  // namespace stillpoint
