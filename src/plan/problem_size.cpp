#include "plan/problem_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "scene/body_solid.hpp"
#include "scene/grid_lines.hpp"
#include "scene/point_sums.hpp"
#include "space/points/numbered_cells.hpp"
#include "space/points/solid_cell_rule.hpp"

namespace stillpoint {
namespace {

/// The first cell of an axis, and one beyond the last.
struct Range {
  double first = 0, end = 0;
  double length() const { return std::max(0.0, end - first); }
};

// The cells along an axis that low to high touches by more than a rounding.
Range touched_cells(const GridSpec& grid, std::size_t axis, double low, double high) {
  constexpr double rounding = 1e-9;
  return {std::floor(cells_before(grid, axis, low) + rounding), std::ceil(cells_before(grid, axis, high) - rounding)};
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
    const Range range = touched_cells(grid, d, body.min[d], body.max[d]);
    for (int line = static_cast<int>(range.first); line <= static_cast<int>(range.end); ++line)
      lines[d].push_back(std::clamp(line_position(grid, d, line), body.min[d], body.max[d]));
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

// The neighbours of a function along an axis, itself included.
struct Neighbours {
  double sharing_cells = 0;
  double all = 0;  // with those that feel the same means, through p splines of degree p − 1 to either side
  double widening() const { return all / sharing_cells; }  // of the parts that separate others
};

Neighbours neighbours_along(const Problem& problem) {
  const int p = degree_of(problem.grid.basis), values = problem.grid.basis == BasisKind::hermite ? 2 : 1;
  const double sharing_cells = values == 2 ? 6 : 2 * p + 1;
  const double through_means = means_over_splines(problem) ? 2 * values * (p + (p - 1) * (2 * p - 1)) : 0;
  return {sharing_cells, sharing_cells + through_means};
}

// Entries of a column of L. With nested dissection their number grows with log n in the plane, and in space as the
// surface of what divides the body, n^(1/3); there are no more than in the band, which is all of them on a line.
double entries_per_column(const Problem& problem, const BodySize& size) {
  const Neighbours neighbours = neighbours_along(problem);
  if (problem.dim == 1) return neighbours.all;
  constexpr std::array in_plane{125.0, 340.0, 620.0, 760.0};  // by basis, of 1e5 unknowns
  constexpr std::array in_space{27.0, 68.0, 110.0};           // by basis, over n^(1/3)
  const auto basis = static_cast<std::size_t>(problem.grid.basis);
  const double octaves = std::log2(std::max(size.unknowns, 1.0) / 1e5);
  const double dissected = problem.dim == 2 ? std::max(0.5, 1 + 0.03 * octaves) * in_plane.at(basis)
                                            : std::cbrt(size.unknowns) * in_space.at(basis);
  return std::min(neighbours.widening() * dissected, 2 * neighbours.widening() * size.width);
}

// As NumberedCells: those of a box around the bodies, or all. occupied: the cells with bodies, along each axis.
double numbered_functions(const Problem& problem, const std::vector<Range>& occupied) {
  double in_box = 1, all = 1, of_box = 1, of_all = 1;
  for (std::size_t d = 0; d < occupied.size(); ++d) {
    const double cells = problem.grid.cells[d];
    const double along = std::min<double>(occupied[d].end + numbered_around, cells) -
                         std::max<double>(occupied[d].first - numbered_around, 0);
    in_box *= along, all *= cells;
    of_box *= functions_along(problem.grid.basis, along), of_all *= functions_along(problem.grid.basis, cells);
  }
  return may_leave_cells_out(problem) && in_box <= most_in_box * all ? of_box : of_all;
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
      const Range range = touched_cells(problem.grid, d, body.min[d], body.max[d]);
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
  for (std::size_t d = 0; d < dim; ++d) {
    in_box *= box[d].length();
    size.longest = std::max(size.longest, box[d].length());
    const double along = functions_along(problem.grid.basis, box[d].length());
    functions *= along;
    widest = std::max(widest, along);
  }
  size.grid_functions = numbered_functions(problem, box);
  const auto components = static_cast<double>(dim);
  size.unknowns = components * functions * std::min(1.0, size.cells / std::max(1.0, in_box));
  size.width = components * functions / widest;
  return size;
}

MatrixSize matrix_size(const Problem& problem, const BodySize& size) {
  constexpr double bytes_of_entry = sizeof(double) + sizeof(int);
  const int dim = problem.dim;
  const double per_column = entries_per_column(problem, size);
  return {.matrix = bytes_of_entry * dim * std::pow(neighbours_along(problem).all, dim) * size.unknowns,
          .assembly =
              size.grid_functions * std::pow(2 * degree_of(problem.grid.basis) + 1, dim) * dim * dim * sizeof(double),
          .entries_per_column = per_column,
          .entries_of_factor = per_column * size.unknowns};
}

bool MatrixSize::factor_fits(const MemoryRoom& room) const {
  constexpr double most_entries = std::numeric_limits<int>::max();  // that CHOLMOD numbers
  return entries_of_factor <= most_entries && assembly + 2 * matrix + factor() <= room.bytes;
}

// A factor takes n m² operations for m entries a column: with more than 900 of them 3 s and more for a body of linear
// cells in space, whose way to rest takes a tenth of that; in the plane only cubic functions have as many.
bool MatrixSize::factor_is_cheap() const {
  constexpr double most_entries_per_column = 900;
  return entries_per_column <= most_entries_per_column;
}

}  // namespace stillpoint
