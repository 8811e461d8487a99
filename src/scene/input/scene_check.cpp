#include "scene/input/scene_check.hpp"

#include <fmt/format.h>

namespace stillpoint {

std::string SceneCheck::body_key(std::size_t k, const std::string& key) const {
  return written("body[0]") ? fmt::format("body[{}].{}", k, key) : "body." + key;
}

std::string SceneCheck::axis_key(const std::string& key, std::size_t axis) const {
  return scene_.dim == 1 ? key : fmt::format("{}[{}]", key, axis);
}

bool SceneCheck::inside(const std::vector<double>& position, const std::vector<double>& min,
                        const std::vector<double>& max, const std::string& box, const std::string& key) {
  if (!position.empty() && position.size() != min.size()) {  // of a program: a file's were counted when they were read
    add(key, fmt::format("expected {} coordinates, found {}", min.size(), position.size()));
    return false;
  }
  for (std::size_t axis = 0; axis < position.size(); ++axis) {
    if (position[axis] >= min[axis] && position[axis] <= max[axis]) continue;
    add(axis_key(key, axis),
        fmt::format("{} lies outside the {}, {} to {}", position[axis], box, min[axis], max[axis]));
    return false;
  }
  return true;
}

const LawInfo* law_of(const SceneCheck& check, const MaterialSpec& material) {
  return check.catalogue().law(material.law);
}

std::string either(const std::vector<std::string>& words) {
  if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

}  // namespace stillpoint
