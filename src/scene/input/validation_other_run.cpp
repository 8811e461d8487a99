// Checks of what a run that begins with the points of another one does not go with.
#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>

#include "scene/input/scene_check.hpp"

namespace stillpoint {

void check_other_run(SceneCheck& check) {
  const Scene& scene = check.scene();
  const std::string from = "initial.from";
  check.refuse_if(scene.initial_from.empty(), "initial", {"displacements"}, "goes with from, another run");
  if (scene.initial_from.empty()) return;
  std::error_code none;
  check.wrong_if(!std::filesystem::is_regular_file(scene.initial_from, none), from, "there is no file {}",
                 scene.initial_from.string());
  check.refuse_if(true, "initial", {"stress"}, "does not go with initial.from, whose stress it is");
  check.wrong_if(scene.geostatic.has_value(), "initial.geostatic", "does not go with initial.from, whose stress it is");
  const auto materials = materials_in_use(scene, check.catalogue());
  const auto is_elastic = [&](const MaterialSpec* one) { return !check.catalogue().law(one->law)->history_dependent; };
  check.wrong_if(scene.displacements_from_zero && scene.phase.deformation == DeformationRule::positions &&
                     std::ranges::any_of(materials, is_elastic),
                 "initial.displacements",
                 "elastic points take their deformation from their displacements; take phase.deformation = "
                 "\"accumulated\"");
  check.wrong_if(
      scene.displacements_from_zero && scene.phase.quadrature == Quadrature::domains, "initial.displacements",
      "domains remember their displacements by their corners; take phase.quadrature = \"points\" in both runs");
  check.refuse_if(true, "initial", {"u", "v"},
                  "does not go with initial.from, where bodies are as another run left them");
}

}  // namespace stillpoint
