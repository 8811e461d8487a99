#include "scene/input/scene_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace stillpoint {

void SceneCheck::add(const std::string& key, const std::string& message) {
  problems_.push_back({scene_.location(key), key + ": " + message});
}

std::string SceneCheck::body_key(std::size_t k, const std::string& key) const {
  return written("body[0]") ? fmt::format("body[{}].{}", k, key) : "body." + key;
}

std::string SceneCheck::axis_key(const std::string& key, std::size_t axis) const {
  return scene_.dim == 1 ? key : fmt::format("{}[{}]", key, axis);
}

double SceneCheck::cell_length(std::size_t axis) const {
  const GridSpec& grid = scene_.grid;
  return axis < grid.cells.size() ? (grid.max[axis] - grid.min[axis]) / grid.cells[axis] : 0;
}

void SceneCheck::snap_to_grid(std::vector<double>& place) const {
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    const double h = cell_length(axis), low = scene_.grid.min[axis], high = scene_.grid.max[axis];
    if (h == 0) continue;
    const double number = std::round((place[axis] - low) / h), cells = scene_.grid.cells[axis];
    const double line = number == cells ? high : low + (high - low) * number / cells;  // as the grid computes it
    if (std::abs(place[axis] - line) <= kSliver * h) place[axis] = line;
  }
}

bool SceneCheck::inside(std::vector<double>& place, const std::vector<double>& min, const std::vector<double>& max,
                        const std::string& box, const std::string& key) {
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    constexpr double rounding = 1e-12;  // of the box and its distance from the origin
    const double slack =
        std::max(rounding * std::max({max[axis] - min[axis], std::abs(min[axis]), std::abs(max[axis])}),
                 2 * kSliver * cell_length(axis));
    if (place[axis] < min[axis] - slack || place[axis] > max[axis] + slack) {
      add(axis_key(key, axis), fmt::format("{} lies outside the {}, {} to {}", place[axis], box, min[axis], max[axis]));
      return false;
    }
    place[axis] = std::clamp(place[axis], min[axis], max[axis]);
  }
  return true;
}

}  // namespace stillpoint
