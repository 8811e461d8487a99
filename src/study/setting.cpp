#include "study/setting.hpp"

#include <utility>

#include "scene/throw_scene_error.hpp"

namespace stillpoint {

Scene with(Scene scene, const Settings& settings) {
  Problem& problem = scene;
  for (const Setting& setting : settings) setting.apply(problem);
  problem = located(scene, [&] { return resolve(problem); });
  return scene;
}

std::vector<std::string> texts_of(const Settings& settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings) texts.push_back(setting.text);
  return texts;
}

}  // namespace stillpoint
