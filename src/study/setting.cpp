#include "study/setting.hpp"

#include <utility>

#include "scene/throw_scene_error.hpp"

namespace stillpoint {

Scene changed(Scene scene, const std::function<void(Problem&)>& change) {
  Problem& problem = scene;
  change(problem);
  problem = located(scene, [&] { return resolve(problem); });
  return scene;
}

Scene with(const Scene& scene, const Settings& settings) {
  return changed(scene, [&](Problem& problem) {
    for (const Setting& setting : settings) setting.apply(problem);
  });
}

std::vector<std::string> texts_of(const Settings& settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings) texts.push_back(setting.text);
  return texts;
}

}  // namespace stillpoint
