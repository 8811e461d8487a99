// Reads a scene with all that this library offers to choose from.
#include <stillpoint/scene.hpp>

#include <utility>

#include "scene/input/read_scene.hpp"
#include "simulation/catalogue.hpp"

namespace stillpoint {

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_scene(file, overrides, catalogue());
}

Scene load_scene(const std::filesystem::path& file, const std::string& text,
                 const std::vector<std::string>& overrides) {
  return read_scene(file, text, overrides, catalogue());
}

Problem resolve(Problem problem) { return resolved(std::move(problem), catalogue()); }

}  // namespace stillpoint
