#include "scene/controlled_loads.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stillpoint {
namespace {

// Those for which keeps(name) holds.
template <class Keeps>
Scene with_loads(const Scene& scene, const Keeps& keeps) {
  Scene chosen = scene;
  chosen.tractions.clear();
  chosen.forces.clear();
  for (std::size_t k = 0; k < scene.tractions.size(); ++k)
    if (keeps(fmt::format("traction[{}]", k))) chosen.tractions.push_back(scene.tractions[k]);
  for (std::size_t k = 0; k < scene.forces.size(); ++k)
    if (keeps(fmt::format("force[{}]", k))) chosen.forces.push_back(scene.forces[k]);
  if (!keeps("body_force")) {
    chosen.body_force.clear();
    chosen.own_load.clear();
  }
  return chosen;
}

bool is_driven(const Scene& scene, const std::string& name) {
  const std::vector<std::string>& driven = scene.load->of;
  return driven.empty() || std::ranges::find(driven, name) != driven.end();
}

}  // namespace

std::vector<std::string> names_of_loads(const Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < scene.tractions.size(); ++k) names.push_back(fmt::format("traction[{}]", k));
  for (std::size_t k = 0; k < scene.forces.size(); ++k) names.push_back(fmt::format("force[{}]", k));
  if (scene.has_body_force()) names.emplace_back("body_force");
  return names;
}

Scene reference_loads(const Scene& scene) {
  Scene driven = with_loads(scene, [&](const std::string& name) { return is_driven(scene, name); });
  driven.supports.clear();
  driven.walls.clear();
  return driven;
}

Scene without_reference_loads(const Scene& scene) {
  if (!scene.load) return scene;
  return with_loads(scene, [&](const std::string& name) { return !is_driven(scene, name); });
}

}  // namespace stillpoint
