#include "scene/grid_lines.hpp"

#include <algorithm>
#include <cmath>

namespace stillpoint {
namespace {

// Line i of n cells whose lengths are in geometric progression. With the ratio q of neighbouring lengths, q^(n−1) = r,
//
//   x_i = from + (to − from) (q^i − 1)/(q^n − 1).
double line_of_piece(const GridPiece& piece, int i) {
  const int n = piece.cells;
  if (i == n) return piece.to;
  const double length = piece.to - piece.from, growth = n > 1 ? std::log(piece.ratio) / (n - 1) : 0;  // ln q
  if (growth == 0) return piece.from + length * i / n;
  return piece.from + length * (std::expm1(i * growth) / std::expm1(n * growth));
}

// The piece that contains x, or the end piece, and the number of cells below it.
std::pair<const GridPiece*, int> piece_at(const std::vector<GridPiece>& pieces, double x) {
  int below = 0;
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k) {
    if (x < pieces[k].to) return {&pieces[k], below};
    below += pieces[k].cells;
  }
  return {&pieces.back(), below};
}

double length_of_cell(const GridSpec& grid, std::size_t axis, int cell) {
  return line_position(grid, axis, cell + 1) - line_position(grid, axis, cell);
}

// The lengths of the end cells of each piece, of which one is the smallest of all cells and one the longest.
std::vector<double> lengths_at_ends(const GridSpec& grid, std::size_t axis) {
  std::vector<double> lengths;
  int below = 0;
  for (const GridPiece& piece : grid.pieces.at(axis)) {
    lengths.push_back(length_of_cell(grid, axis, below));
    below += piece.cells;
    lengths.push_back(length_of_cell(grid, axis, below - 1));
  }
  return lengths;
}

// How far a position may miss an end of a box along an axis and still be taken to lie in it [m]. cell: at that end.
double slack_of(double min, double max, double cell) {
  constexpr double rounding = 1e-12;  // as a share of the box and its distance from the origin
  return std::max(rounding * std::max({max - min, std::abs(min), std::abs(max)}), 2 * kSliver * cell);
}

}  // namespace

void take_extent_of_pieces(GridSpec& grid) {
  grid.min.clear(), grid.max.clear(), grid.cells.clear();
  for (std::vector<GridPiece>& pieces : grid.pieces) {
    if (pieces.empty()) continue;
    for (std::size_t k = 1; k < pieces.size(); ++k) pieces[k].from = pieces[k - 1].to;
    grid.min.push_back(pieces.front().from);
    grid.max.push_back(pieces.back().to);
    grid.cells.push_back(0);
    for (const GridPiece& piece : pieces) grid.cells.back() += piece.cells;
  }
}

bool has_equal_cells(const GridSpec& grid, std::size_t axis) {
  if (!grid.is_by_pieces()) return true;
  const std::vector<GridPiece>& pieces = grid.pieces.at(axis);
  return pieces.size() == 1 && (pieces.front().ratio == 1 || pieces.front().cells == 1);
}

double line_position(const GridSpec& grid, std::size_t axis, int line) {
  const double min = grid.min[axis], max = grid.max[axis];
  const int cells = grid.cells[axis];
  if (line >= cells) return max;
  if (has_equal_cells(grid, axis)) return min + (max - min) * line / cells;
  for (const GridPiece& piece : grid.pieces.at(axis)) {
    if (line < piece.cells) return line_of_piece(piece, line);
    line -= piece.cells;
  }
  return max;
}

std::vector<double> grid_lines(const GridSpec& grid, std::size_t axis) {
  std::vector<double> lines;
  if (has_equal_cells(grid, axis)) {
    for (int line = 0; line <= grid.cells[axis]; ++line) lines.push_back(line_position(grid, axis, line));
    return lines;
  }
  for (const GridPiece& piece : grid.pieces.at(axis))
    for (int i = 0; i < piece.cells; ++i) lines.push_back(line_of_piece(piece, i));
  lines.push_back(grid.max[axis]);
  return lines;
}

int cell_at(const GridSpec& grid, std::size_t axis, double x) {
  if (has_equal_cells(grid, axis)) {
    const double last = grid.cells[axis] - 1;
    return static_cast<int>(std::clamp(std::floor(cells_before(grid, axis, x)), 0.0, last));
  }
  const auto [piece, below] = piece_at(grid.pieces.at(axis), x);
  int low = 0, high = piece->cells;  // line `low` of the piece is at most x, or its first
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (line_of_piece(*piece, middle) <= x ? low : high) = middle;
  }
  return below + low;
}

int nearest_line(const GridSpec& grid, std::size_t axis, double x) {
  if (has_equal_cells(grid, axis)) {
    const double cells = grid.cells[axis];
    return static_cast<int>(std::clamp(std::round(cells_before(grid, axis, x)), 0.0, cells));
  }
  const int cell = cell_at(grid, axis, x);
  const bool is_above = line_position(grid, axis, cell + 1) - x < x - line_position(grid, axis, cell);
  return is_above ? cell + 1 : cell;
}

bool is_on_line(const GridSpec& grid, std::size_t axis, double x) {
  constexpr double rounding = 1e-12;  // as a share of a cell
  return std::abs(x - line_position(grid, axis, nearest_line(grid, axis, x))) <=
         rounding * cell_length_at(grid, axis, x);
}

double cells_before(const GridSpec& grid, std::size_t axis, double x) {
  if (has_equal_cells(grid, axis)) return (x - grid.min[axis]) / mean_cell(grid, axis);
  const int cell = cell_at(grid, axis, x);
  return cell + (x - line_position(grid, axis, cell)) / length_of_cell(grid, axis, cell);
}

double cells_between(const GridSpec& grid, std::size_t axis, double from, double to) {
  if (has_equal_cells(grid, axis)) return (to - from) / mean_cell(grid, axis);
  return cells_before(grid, axis, to) - cells_before(grid, axis, from);
}

double cell_length_at(const GridSpec& grid, std::size_t axis, double x) {
  return has_equal_cells(grid, axis) ? mean_cell(grid, axis) : length_of_cell(grid, axis, cell_at(grid, axis, x));
}

double known_cell_length_at(const GridSpec& grid, std::size_t axis, double x) {
  return axis < grid.cells.size() ? cell_length_at(grid, axis, x) : 0;
}

double smallest_cell(const GridSpec& grid, std::size_t axis) {
  return has_equal_cells(grid, axis) ? mean_cell(grid, axis) : std::ranges::min(lengths_at_ends(grid, axis));
}

double longest_cell(const GridSpec& grid, std::size_t axis) {
  return has_equal_cells(grid, axis) ? mean_cell(grid, axis) : std::ranges::max(lengths_at_ends(grid, axis));
}

double mean_cell(const GridSpec& grid, std::size_t axis) {
  return (grid.max[axis] - grid.min[axis]) / grid.cells[axis];
}

double mean_cell(const GridSpec& grid) {
  double volume = 1;
  for (std::size_t axis = 0; axis < grid.cells.size(); ++axis) volume *= mean_cell(grid, axis);
  return std::pow(volume, 1 / static_cast<double>(grid.cells.size()));
}

double longest_cell(const GridSpec& grid) {
  double longest = 0;
  for (std::size_t axis = 0; axis < grid.cells.size(); ++axis) longest = std::max(longest, longest_cell(grid, axis));
  return longest;
}

double longest_of_smallest_sides(const GridSpec& grid) {
  double longest = 0;
  for (std::size_t axis = 0; axis < grid.cells.size(); ++axis) longest = std::max(longest, smallest_cell(grid, axis));
  return longest;
}

double longest_mean_cell(const GridSpec& grid) {
  double longest = 0;
  for (std::size_t axis = 0; axis < grid.cells.size(); ++axis) longest = std::max(longest, mean_cell(grid, axis));
  return longest;
}

void move_into(std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
               const GridSpec& grid) {
  for (std::size_t axis = 0; axis < std::min(position.size(), min.size()); ++axis) {
    const auto slack_at = [&](double end) {
      return slack_of(min[axis], max[axis], known_cell_length_at(grid, axis, end));
    };
    if (position[axis] < min[axis] - slack_at(min[axis]) || position[axis] > max[axis] + slack_at(max[axis])) return;
    position[axis] = std::clamp(position[axis], min[axis], max[axis]);
  }
}

void snap_to_lines(std::vector<double>& position, const GridSpec& grid) {
  for (std::size_t axis = 0; axis < std::min(position.size(), grid.cells.size()); ++axis) {
    const double low = grid.min[axis], high = grid.max[axis], cells = grid.cells[axis];
    double line = 0;
    if (has_equal_cells(grid, axis)) {  // also outside the grid, where a shape may reach that the scene cuts off
      const double number = std::round(cells_before(grid, axis, position[axis]));
      line = number == cells ? high : low + (high - low) * number / cells;  // as the grid computes it
    } else {
      line = line_position(grid, axis, nearest_line(grid, axis, position[axis]));
    }
    if (std::abs(position[axis] - line) <= kSliver * cell_length_at(grid, axis, position[axis])) position[axis] = line;
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
