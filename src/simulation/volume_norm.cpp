#include "simulation/volume_norm.hpp"

#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <functional>

namespace stillpoint {
namespace {

bool same_density(const Problem& problem) {
  const auto density = [&](const BodySpec& body) { return problem.materials.at(body.material).parameters.at("rho"); };
  return std::ranges::adjacent_find(problem.bodies, std::ranges::not_equal_to{}, density) == problem.bodies.end();
}
bool same_material(const Problem& problem) {
  return std::ranges::adjacent_find(problem.bodies, std::ranges::not_equal_to{}, &BodySpec::material) ==
         problem.bodies.end();
}

Mass mass_of_density_1(Problem problem) {
  for (auto& [name, material] : problem.materials) material.parameters["rho"] = 1;
  problem.mass.scaling = MassScaling::uniform;
  problem.mass.factor = 1;
  return make_phase(problem)->mass();
}

}  // namespace

bool mass_measures_volume(const Problem& problem, bool scaled) {
  return scaled ? same_material(problem) : same_density(problem);
}

std::optional<VolumeNorm> volume_norm(const Problem& problem, const LagrangianPhase& phase, bool scaled, ConstVec u) {
  if (mass_measures_volume(problem, scaled)) return std::nullopt;
  VolumeNorm norm{.V = mass_of_density_1(problem)};
  const FrequencyEstimate lowest = lowest_frequency(phase.tangents().matrix(Tangent::elastic, 0, u), norm.V);
  if (!lowest.converged) return std::nullopt;
  norm.omega_1 = lowest.omega;
  return norm;
}

}  // namespace stillpoint
