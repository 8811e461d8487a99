#include "scene/grid_fault.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/grid_lines.hpp"

namespace stillpoint {
namespace {

constexpr double most_cells = 1e8;  // about 1 GB for a vector of a plane grid's unknowns

GridFault too_many(double cells) {
  return {.key = "cells",
          .message = fmt::format("{:.3g} cells are more than this program takes ({:g})", cells, most_cells)};
}

// Whether grid lines this far apart could be told from each other, so far from the origin.
bool is_large_enough(double cell, double min, double max) {
  constexpr double relative = 1e-12;
  return cell > relative * std::max(std::abs(min), std::abs(max)) && cell > 1e-300;
}

// before: the piece below; null: there is none.
GridFault fault_of_piece(const GridPiece& piece, const GridPiece* before, const std::string& key) {
  constexpr double rounding = 1e-12;  // as a share of the positions
  const auto entry = [&](int k) { return fmt::format("{}[{}]", key, k); };
  const double largest = std::max(std::abs(piece.from), std::abs(piece.to));
  if (before && !(std::abs(piece.from - before->to) <= rounding * largest))
    return {.key = entry(0),
            .message =
                fmt::format("a piece begins where the one before it ends, at {}, not at {}", before->to, piece.from)};
  if (!(piece.to > piece.from))
    return {.key = entry(1),
            .message = fmt::format("must be greater than {}, where the piece begins, not {}", piece.from, piece.to)};
  if (!std::isfinite(piece.to - piece.from))
    return {.key = entry(1), .message = "the length of the piece is not a finite number"};
  if (piece.cells < 1) return {.key = entry(2), .message = fmt::format("must be at least 1, not {}", piece.cells)};
  if (!(piece.ratio > 0) || !std::isfinite(piece.ratio))
    return {.key = entry(3), .message = fmt::format("must be greater than 0, not {}", piece.ratio)};
  if (piece.cells == 1 && piece.ratio != 1)
    return {.key = entry(3),
            .message = fmt::format("is the length of a piece's last cell over that of its first, of which this one has "
                                   "the same: leave {} out",
                                   piece.ratio)};
  return {};
}

}  // namespace

GridFault fault_of_pieces(const Problem& problem) {
  if (!problem.grid.is_by_pieces()) return {};
  constexpr const char* names = "xyz";
  const auto dim = static_cast<std::size_t>(problem.dim);
  double all = 1;
  for (std::size_t axis = 0; axis < problem.grid.pieces.size(); ++axis) {
    const std::vector<GridPiece>& pieces = problem.grid.pieces[axis];
    if (axis >= dim && !pieces.empty())
      return {.key = {names[axis]}, .message = fmt::format("there is no {} in {} dimensions", names[axis], dim)};
    if (axis >= dim) continue;
    if (pieces.empty())
      return {
          .key = "",
          .message = fmt::format("the key '{}' is missing: where one axis is given by pieces, all are", names[axis])};
    double along = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      GridFault fault =
          fault_of_piece(pieces[k], k > 0 ? &pieces[k - 1] : nullptr, fmt::format("{}[{}]", names[axis], k));
      if (!fault.empty()) return fault;
      along += pieces[k].cells;
    }
    all *= along;
    if (all > most_cells) {
      GridFault fault = too_many(all);
      fault.key = {names[axis]};
      return fault;
    }
  }
  return {};
}

GridFault fault_of_grid(const Problem& problem) {
  const GridSpec& grid = problem.grid;
  const auto dim = static_cast<std::size_t>(problem.dim);
  if (GridFault fault = fault_of_pieces(problem); !fault.empty()) return fault;
  if (grid.min.size() != dim || grid.max.size() != dim || (!grid.cells.empty() && grid.cells.size() != dim))
    return {.key = "", .message = fmt::format("has not {} values for each of min, max and cells", dim)};
  const auto name = [&](const char* key, std::size_t axis) {
    return dim == 1 ? fmt::format("grid.{}", key) : fmt::format("grid.{}[{}]", key, axis);
  };
  for (std::size_t axis = 0; axis < dim; ++axis) {
    const int number = static_cast<int>(axis);
    const double min = grid.min[axis], max = grid.max[axis], length = max - min;
    if (!(length > 0))
      return {"max", number, fmt::format("must be greater than {} = {}, not {}", name("min", axis), min, max)};
    if (!std::isfinite(length)) return {"max", number, "the grid's length is not a finite number"};
    if (grid.is_by_pieces() && !is_large_enough(smallest_cell(grid, axis), min, max))
      return {.key = {"xyz"[axis]},
              .message = fmt::format("the smallest cell, of {:.3g} m, is too small for double precision",
                                     smallest_cell(grid, axis))};
    if (!grid.is_by_pieces() && !grid.cells.empty() && !is_large_enough(length / grid.cells[axis], min, max))
      return {"cells", number,
              fmt::format("{} cells between {} and {} are too small for double precision", grid.cells[axis], min, max)};
  }
  double cells = 1;
  for (const int along : grid.cells) cells *= along;
  return cells > most_cells ? too_many(cells) : GridFault{};
}

}  // namespace stillpoint
