#include "simulation/advice/unit_notes.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

using Notes = std::vector<std::string>;

double parameter(const MaterialSpec& material, const std::string& name) {
  const auto found = material.parameters.find(name);
  return found == material.parameters.end() || material.by_place.contains(name) ? 0 : found->second;
}

void note_angles(const MaterialSpec& material, Notes& notes) {
  constexpr double right_angle = 1.6;  // [rad], rounded up
  for (const char* const angle : {"phi", "psi"}) {
    const double value = parameter(material, angle);
    if (value > 0 && value < right_angle)
      notes.push_back(
          fmt::format("material.{}.{} = {:g} is taken as degrees: if radians are meant, they are {:.4g} degrees",
                      material.name, angle, value, value * 180 / std::acos(-1.0)));
  }
}

// Scenes without units, or in kN or N and mm, have lesser moduli.
void note_density(const MaterialSpec& material, Notes& notes) {
  constexpr double modulus_in_pascal = 1e6, lightest = 30, heaviest = 30'000;
  const double rho = parameter(material, "rho");
  const double stiffest = std::max({parameter(material, "E"), parameter(material, "G"), parameter(material, "K")});
  if (stiffest >= modulus_in_pascal && rho > 0 && (rho < lightest || rho > heaviest))
    notes.push_back(
        fmt::format("material.{}.rho = {:g} is the density of no solid in kg/m³, beside a modulus of {:g} Pa: units "
                    "have to be consistent, as N, m, kg and s are",
                    material.name, rho, stiffest));
}

void note_gravity(const Problem& problem, Notes& notes) {
  const std::size_t up = dimension_info(problem.dim).vertical;
  if (problem.dim == 1 || problem.body_force.size() <= up || !problem.body_force[up].constant()) return;
  const double g = problem.body_force[up]({}, 0);
  constexpr double least = 9.7, most = 9.9;  // [m/s²]
  if (g > least && g < most)
    notes.push_back(fmt::format("body_force points up, along +{}: of gravity the value is -{:g}", "xyz"[up], g));
}

void note_stages(const Problem& problem, Notes& notes) {
  const double end = problem.stop.time;
  const auto late = std::ranges::find_if(problem.output.snapshots, [&](double t) { return t > end; });
  if (end > 0 && late != problem.output.snapshots.end())
    notes.push_back(fmt::format("output.stages has {:g}, and the run ends at stop.time = {:g}: nothing is written then",
                                *late, end));
}

}  // namespace

std::vector<std::string> unit_notes(const Problem& problem) {
  Notes notes;
  for (const auto& [name, material] : problem.materials) {
    note_angles(material, notes);
    note_density(material, notes);
  }
  note_gravity(problem, notes);
  note_stages(problem, notes);
  return notes;
}

}  // namespace stillpoint
