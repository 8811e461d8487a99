#include "scene/input/scene_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace stillpoint {

std::string SceneCheck::body_key(std::size_t k, const std::string& key) const {
  return written("body[0]") ? fmt::format("body[{}].{}", k, key) : "body." + key;
}

std::string SceneCheck::axis_key(const std::string& key, std::size_t axis) const {
  return scene_.dim == 1 ? key : fmt::format("{}[{}]", key, axis);
}

double SceneCheck::cell_length(std::size_t axis) const {
  const GridSpec& grid = scene_.grid;
  return axis < grid.cells.size() ? grid.cell_length(axis) : 0;
}

void SceneCheck::snap_to_grid(std::vector<double>& position) const {
  for (std::size_t axis = 0; axis < position.size(); ++axis) {
    const double h = cell_length(axis), low = scene_.grid.min[axis], high = scene_.grid.max[axis];
    if (h == 0) continue;
    const double number = std::round((position[axis] - low) / h), cells = scene_.grid.cells[axis];
    const double line = number == cells ? high : low + (high - low) * number / cells;  // as the grid computes it
    if (std::abs(position[axis] - line) <= kSliver * h) position[axis] = line;
  }
}

bool SceneCheck::inside(std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
                        const std::string& box, const std::string& key) {
  for (std::size_t axis = 0; axis < position.size(); ++axis) {
    constexpr double rounding = 1e-12;  // of the box and its distance from the origin
    const double slack =
        std::max(rounding * std::max({max[axis] - min[axis], std::abs(min[axis]), std::abs(max[axis])}),
                 2 * kSliver * cell_length(axis));
    if (position[axis] < min[axis] - slack || position[axis] > max[axis] + slack) {
      add(axis_key(key, axis),
          fmt::format("{} lies outside the {}, {} to {}", position[axis], box, min[axis], max[axis]));
      return false;
    }
    position[axis] = std::clamp(position[axis], min[axis], max[axis]);
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
