#include "simulation/volume_norm.hpp"

#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <functional>

namespace stillpoint {
namespace {

bool same_density(const Scene& scene) {
  const auto density = [&](const BodySpec& body) { return scene.materials.at(body.material).parameters.at("rho"); };
  return std::ranges::adjacent_find(scene.bodies, std::ranges::not_equal_to{}, density) == scene.bodies.end();
}
bool same_material(const Scene& scene) {
  return std::ranges::adjacent_find(scene.bodies, std::ranges::not_equal_to{}, &BodySpec::material) ==
         scene.bodies.end();
}

Mass mass_of_density_1(Scene scene) {
  for (auto& [name, material] : scene.materials) material.parameters["rho"] = 1;
  scene.mass.scaling = MassScaling::uniform;
  scene.mass.factor = 1;
  return make_phase(scene)->mass();
}

}  // namespace

bool mass_measures_volume(const Scene& scene, bool scaled) {
  return scaled ? same_material(scene) : same_density(scene);
}

std::optional<VolumeNorm> volume_norm(const Scene& scene, const LagrangianPhase& phase, bool scaled, ConstVec u) {
  if (mass_measures_volume(scene, scaled)) return std::nullopt;
  VolumeNorm norm{.V = mass_of_density_1(scene)};
  const FrequencyEstimate lowest = lowest_frequency(phase.tangents().matrix(Tangent::elastic, 0, u), norm.V);
  if (!lowest.converged) return std::nullopt;
  norm.omega_1 = lowest.omega;
  return norm;
}

}  // namespace stillpoint
