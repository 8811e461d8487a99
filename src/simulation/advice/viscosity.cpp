#include <cmath>

#include <fmt/format.h>

#include "simulation/advice/notes.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {
namespace {

std::vector<std::string> viscous_materials(const Problem& problem) {
  std::vector<std::string> names;
  for (const auto& [name, material] : problem.materials)
    if (is_viscous(material)) names.push_back(name);
  return names;
}

std::string fluidity_of(const std::string& material) { return fmt::format("material.{}.fluidity", material); }

// If the strain is held f falls as e^{−t/τ},  τ = 1/(β (G + K η η̄)) ≤ 1/(β G).
double longest_time_constant(const MaterialSpec& material) {
  const double G = material.parameters.at("E") / (2 * (1 + material.parameters.at("nu")));
  return 1 / (material.parameters.at("fluidity") * G);
}

}  // namespace

std::string creep(const Problem& problem, const LagrangianPhase& phase) {
  const std::optional<OverStress> over = phase.fields().over_stress();
  if (!over || over->share <= largest_over_stress) return "";
  std::vector<std::string> keys;
  for (const std::string& name : viscous_materials(problem)) keys.push_back(fluidity_of(name));
  return fmt::format(
      "it creeps: at {} the yield function is {:.3g} of the strength, and equilibrium takes {:g} of it; what is beyond "
      "its strength flows on by {}, however slowly: expected smaller loads, more time for it, or solve.method = "
      "\"newton\", whose law is rate-independent",
      to_string(phase.diagnosis().of_point(over->point)), over->share, largest_over_stress, fmt::join(keys, ", "));
}

std::vector<std::string> viscosity_notes(const Problem& problem, double step) {
  std::vector<std::string> notes;
  for (const std::string& name : viscous_materials(problem)) {
    if (problem.solve.is_static()) {
      notes.push_back(fmt::format(
          "{} has no part in a static solution, in which no time passes: the law is the rate-independent one, to which "
          "the viscous one comes in the long run",
          fluidity_of(name)));
      continue;
    }
    if (!problem.stop.wants_equilibrium() || !(step > 0) || problem.materials.at(name).by_place.contains("E")) continue;
    const double constant = longest_time_constant(problem.materials.at(name));
    const double time = -std::log(largest_over_stress) * constant;
    std::string limit;
    if (problem.stop.time > 0 && time > problem.stop.time)
      limit = fmt::format("stop.time is {:.6g} s", problem.stop.time);
    if (problem.stop.steps > 0 && time / step > static_cast<double>(problem.stop.steps))
      limit = fmt::format("stop.steps is {}", problem.stop.steps);
    if (limit.empty()) continue;
    notes.push_back(
        fmt::format("{} lets what is beyond its strength flow with a time constant of {:.2g} s: if anything yields, "
                    "equilibrium takes {:.2g} s or {:.2g} steps, and {}; expected a larger fluidity, or solve.method = "
                    "\"newton\", whose law is rate-independent",
                    fluidity_of(name), constant, time, time / step, limit));
  }
  return notes;
}

}  // namespace stillpoint
