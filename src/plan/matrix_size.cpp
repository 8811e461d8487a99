#include "plan/matrix_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/point_sums.hpp"

namespace stillpoint {
namespace {

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

}  // namespace

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
