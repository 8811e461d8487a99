#include "scene/grid_lines.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace stillpoint {
namespace {

// How far a position may miss a box along an axis and still be taken to lie in it [m].
double slack_of(double min, double max, double cell_length) {
  constexpr double rounding = 1e-12;  // as a share of the box and its distance from the origin
  return std::max(rounding * std::max({max - min, std::abs(min), std::abs(max)}), 2 * kSliver * cell_length);
}

}  // namespace

GridFault fault_of_grid(const Problem& problem) {
  const GridSpec& grid = problem.grid;
  const auto dim = static_cast<std::size_t>(problem.dim);
  if (grid.min.size() != dim || grid.max.size() != dim || (!grid.cells.empty() && grid.cells.size() != dim))
    return {.key = "", .message = fmt::format("has not {} values for each of min, max and cells", dim)};
  const auto name = [&](const char* key, std::size_t axis) {
    return dim == 1 ? fmt::format("grid.{}", key) : fmt::format("grid.{}[{}]", key, axis);
  };
  for (std::size_t axis = 0; axis < dim; ++axis) {
    const int number = static_cast<int>(axis);
    const double length = grid.max[axis] - grid.min[axis];
    if (!(length > 0))
      return {"max", number,
              fmt::format("must be greater than {} = {}, not {}", name("min", axis), grid.min[axis], grid.max[axis])};
    if (!std::isfinite(length)) return {"max", number, "the grid's length is not a finite number"};
    // Grid lines a few roundings apart could not be told from each other.
    const double largest = std::max(std::abs(grid.min[axis]), std::abs(grid.max[axis]));
    constexpr double relative = 1e-12;
    if (!grid.cells.empty() &&
        !(length / grid.cells[axis] > relative * largest && length / grid.cells[axis] > 1e-300)) {
      return {"cells", number,
              fmt::format("{} cells between {} and {} are too small for double precision", grid.cells[axis],
                          grid.min[axis], grid.max[axis])};
    }
  }
  constexpr double most = 1e8;  // about 1 GB for a vector of a plane grid's unknowns
  double cells = 1;
  for (const int along : grid.cells) cells *= along;
  if (cells > most)
    return {.key = "cells",
            .message = fmt::format("{:.3g} cells are more than this program takes ({:g})", cells, most)};
  return {};
}

double known_cell_length(const GridSpec& grid, std::size_t axis) {
  return axis < grid.cells.size() ? grid.cell_length(axis) : 0;
}

void move_into(std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
               const GridSpec& grid) {
  for (std::size_t axis = 0; axis < std::min(position.size(), min.size()); ++axis) {
    const double slack = slack_of(min[axis], max[axis], known_cell_length(grid, axis));
    if (position[axis] < min[axis] - slack || position[axis] > max[axis] + slack) return;
    position[axis] = std::clamp(position[axis], min[axis], max[axis]);
  }
}

void snap_to_lines(std::vector<double>& position, const GridSpec& grid) {
  for (std::size_t axis = 0; axis < std::min(position.size(), grid.min.size()); ++axis) {
    const double h = known_cell_length(grid, axis), low = grid.min[axis], high = grid.max[axis];
    if (h == 0) continue;
    const double number = std::round((position[axis] - low) / h), cells = grid.cells[axis];
    const double line = number == cells ? high : low + (high - low) * number / cells;  // as the grid computes it
    if (std::abs(position[axis] - line) <= kSliver * h) position[axis] = line;
  }
}

std::pair<std::vector<double>, std::vector<double>> box_around(const std::vector<BodySpec>& bodies) {
  std::vector<double> low = bodies.front().min, high = bodies.front().max;
  for (const BodySpec& body : bodies) {
    for (std::size_t axis = 0; axis < std::min({low.size(), body.min.size(), body.max.size()}); ++axis) {
      low[axis] = std::min(low[axis], body.min[axis]);
      high[axis] = std::max(high[axis], body.max[axis]);
    }
  }
  return {std::move(low), std::move(high)};
}

}  // namespace stillpoint
