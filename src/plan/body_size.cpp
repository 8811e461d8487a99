#include "plan/body_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "scene/body_solid.hpp"
#include "space/points/solid_cell_rule.hpp"

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

/// Cells of a solid in space that hold points, and those points.
struct Filled {
  double cells = 0, points = 0;
};

// Cells that the surface may cut are looked at one by one, or every so many of them, so that the time is bounded.
Filled filled_by_solid(const GridSpec& grid, const BodySpec& body, double per_cell) {
  constexpr std::size_t most_cells_looked_at = 1000;
  constexpr double sliver = 1e-6;  // share of a cell that has no points
  const auto solid = solid_of(body);
  std::array<std::vector<double>, 3> lines;  // borders of the cells in the body's box
  for (std::size_t d = 0; d < 3; ++d) {
    const Range range = cells_between(grid, d, body.min[d], body.max[d]);
    for (int c = 0; c <= static_cast<int>(range.length()); ++c)
      lines[d].push_back(std::clamp(grid.min[d] + (range.first + c) * grid.cell_length(d), body.min[d], body.max[d]));
  }
  Filled filled;
  std::vector<SpaceBox> cut;
  for (std::size_t k = 0; k + 1 < lines[2].size(); ++k) {
    for (std::size_t j = 0; j + 1 < lines[1].size(); ++j) {
      for (std::size_t i = 0; i + 1 < lines[0].size(); ++i) {
        const SpaceBox cell{{lines[0][i], lines[1][j], lines[2][k]},
                            {lines[0][i + 1], lines[1][j + 1], lines[2][k + 1]}};
        const Solid::Part part = solid->part_of(cell);
        if (part == Solid::Part::some) cut.push_back(cell);
        if (part == Solid::Part::all) filled.cells += 1;
      }
    }
  }
  filled.points = filled.cells * per_cell;
  const bool gauss = body.placement == Placement::gauss && body.volumes == VolumeRule::consistent && body.jitter == 0;
  const double of_gauss = static_cast<double>(count_of_gauss_points(static_cast<std::size_t>(per_cell)));
  const std::size_t step = 1 + cut.size() / most_cells_looked_at;
  for (std::size_t c = 0; c < cut.size(); c += step) {
    const double share = volume_in(*solid, cut[c]) / cut[c].volume(),
                 for_cells = static_cast<double>(std::min(step, cut.size() - c));
    if (!(share > sliver)) continue;
    filled.cells += for_cells;
    filled.points += for_cells * (share > 1 - 1e-9 ? per_cell : gauss ? of_gauss : std::max(1.0, share * per_cell));
  }
  return filled;
}

}  // namespace

BodySize body_size(const Problem& problem) {
  BodySize size;
  const std::size_t dim = problem.grid.cells.size();
  std::vector<Range> box(dim, {std::numeric_limits<double>::infinity(), 0});
  double most = -1;
  for (std::size_t k = 0; k < problem.bodies.size(); ++k) {
    const BodySpec& body = problem.bodies[k];
    double cells = is_solid(body) ? 1 : share_of_box(body), per_cell = 1;
    for (std::size_t d = 0; d < dim; ++d) {
      const Range range = cells_between(problem.grid, d, body.min[d], body.max[d]);
      cells *= range.length();
      if (body.file.empty()) per_cell *= body.points_per_cell[d];
      box[d] = {std::min(box[d].first, range.first), std::max(box[d].end, range.end)};
    }
    double points = body.file.empty() ? cells * per_cell : lines_in(body.file);
    if (is_solid(body)) {
      const Filled filled = filled_by_solid(problem.grid, body, per_cell);
      cells = filled.cells;
      points = filled.points;
    }
    size.points += points;
    size.body_points.push_back(points);
    size.cells += body.file.empty() ? cells : std::min(cells, points);
    if (points <= most) continue;
    most = points;
    const char* key = body.file.empty() ? "points_per_cell" : "file";
    size.most_points = problem.bodies.size() > 1 ? fmt::format("body[{}].{}", k, key) : fmt::format("body.{}", key);
  }
  double in_box = 1, functions = 1, widest = 1;
  size.grid_functions = 1;
  for (std::size_t d = 0; d < dim; ++d) {
    in_box *= box[d].length();
    const double along = functions_along(problem.grid.basis, box[d].length());
    functions *= along;
    widest = std::max(widest, along);
    size.grid_functions *= functions_along(problem.grid.basis, problem.grid.cells[d]);
  }
  const auto components = static_cast<double>(dim);
  size.unknowns = components * functions * std::min(1.0, size.cells / std::max(1.0, in_box));
  size.width = components * functions / widest;
  return size;
}

}  // namespace stillpoint
