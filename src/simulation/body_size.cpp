#include "simulation/body_size.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "scene/body_solid.hpp"

namespace stillpoint {
namespace {

// The cells along an axis that low to high touches by more than a rounding: the first, and one beyond the last.
struct Range {
  double first = 0, end = 0;
  double length() const { return std::max(0.0, end - first); }
};

Range cells_between(const GridSpec& grid, std::size_t axis, double low, double high) {
  constexpr double rounding = 1e-9;
  const double h = grid.cell_length(axis);
  return {std::floor((low - grid.min[axis]) / h + rounding), std::ceil((high - grid.min[axis]) / h - rounding)};
}

double lines_in(const std::filesystem::path& file) {
  std::ifstream text(file, std::ios::binary);
  return static_cast<double>(std::count(std::istreambuf_iterator<char>(text), {}, '\n'));
}

double functions_along(BasisKind basis, double cells) {
  return basis == BasisKind::hermite ? 2 * (cells + 1) : cells + degree_of(basis);
}

}  // namespace

BodySize body_size(const Scene& scene) {
  BodySize size;
  const std::size_t dim = scene.grid.cells.size();
  std::vector<Range> box(dim, {std::numeric_limits<double>::infinity(), 0});
  double most = -1;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    const BodySpec& body = scene.bodies[k];
    double cells = share_of_box(body), per_cell = 1;
    for (std::size_t d = 0; d < dim; ++d) {
      const Range range = cells_between(scene.grid, d, body.min[d], body.max[d]);
      cells *= range.length();
      if (body.file.empty()) per_cell *= body.points_per_cell[d];
      box[d] = {std::min(box[d].first, range.first), std::max(box[d].end, range.end)};
    }
    const double points = body.file.empty() ? cells * per_cell : lines_in(body.file);
    size.points += points;
    size.body_points.push_back(points);
    size.cells += body.file.empty() ? cells : std::min(cells, points);
    if (points <= most) continue;
    most = points;
    const char* key = body.file.empty() ? "points_per_cell" : "file";
    size.most_points = scene.bodies.size() > 1 ? fmt::format("body[{}].{}", k, key) : fmt::format("body.{}", key);
  }
  double in_box = 1, functions = 1, widest = 1;
  size.grid_functions = 1;
  for (std::size_t d = 0; d < dim; ++d) {
    in_box *= box[d].length();
    const double along = functions_along(scene.grid.basis, box[d].length());
    functions *= along;
    widest = std::max(widest, along);
    size.grid_functions *= functions_along(scene.grid.basis, scene.grid.cells[d]);
  }
  const auto components = static_cast<double>(dim);
  size.unknowns = components * functions * std::min(1.0, size.cells / std::max(1.0, in_box));
  size.width = components * functions / widest;
  return size;
}

}  // namespace stillpoint
