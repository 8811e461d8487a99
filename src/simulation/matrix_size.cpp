#include "simulation/matrix_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/memory_room.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

// Neighbours of a function, itself included, along an axis: those that share a cell with it; or those that feel the
// same means, through p splines of degree p − 1 to either side of those that they share cells with.
double own_neighbours_along(const Problem& problem) {
  return problem.grid.basis == BasisKind::hermite ? 6 : 2 * degree_of(problem.grid.basis) + 1;
}
double neighbours_along(const Problem& problem) {
  if (!means_over_splines(problem)) return own_neighbours_along(problem);
  const int p = degree_of(problem.grid.basis), values = problem.grid.basis == BasisKind::hermite ? 2 : 1;
  return own_neighbours_along(problem) + 2 * values * (p + (p - 1) * (2 * p - 1));
}
double neighbours(const Problem& problem) { return std::pow(neighbours_along(problem), problem.dim); }

// Entries of a column of L. With nested dissection their number grows with log n in the plane, and in space as the
// surface of what divides the body, n^(1/3); no more than the band, which is all of them on a line.
double by_means(const Problem& problem) {  // what separates parts is wider
  return neighbours_along(problem) / own_neighbours_along(problem);
}
double of_band(const Problem& problem, const BodySize& size) { return 2 * by_means(problem) * size.width; }
std::size_t basis_number(const Problem& problem) { return static_cast<std::size_t>(problem.grid.basis); }

double entries_on_line(const Problem& problem, const BodySize&) { return neighbours(problem); }
double entries_in_plane(const Problem& problem, const BodySize& size) {
  constexpr double measured_at = 1e5, by_octave = 0.03;
  constexpr std::array<double, 4> of_basis{125, 340, 620, 760};
  const double growth = 1 + by_octave * std::log2(std::max(size.unknowns, 1.0) / measured_at);
  return std::min(by_means(problem) * (std::max(0.5, growth) * of_basis[basis_number(problem)]),
                  of_band(problem, size));
}
double entries_in_space(const Problem& problem, const BodySize& size) {
  constexpr std::array<double, 3> of_basis{27, 68, 110};
  return std::min(by_means(problem) * (std::cbrt(size.unknowns) * of_basis[basis_number(problem)]),
                  of_band(problem, size));
}
constexpr std::array entries_of_column{&entries_on_line, &entries_in_plane, &entries_in_space};

double entries_of_factor(const Problem& problem, const BodySize& size) {
  return of_dimension(entries_of_column, problem.dim)(problem, size) * size.unknowns;
}

}  // namespace

double bytes_of_matrix(const Problem& problem, const BodySize& size) {
  constexpr double of_entry = sizeof(double) + sizeof(int);
  return of_entry * problem.dim * neighbours(problem) * size.unknowns;
}

double bytes_of_factor(const Problem& problem, const BodySize& size) {
  return sizeof(double) * entries_of_factor(problem, size);
}

double bytes_of_assembly(const Problem& problem, const BodySize& size) {
  const double along = 2 * degree_of(problem.grid.basis) + 1;
  return size.grid_functions * std::pow(along, problem.dim) * problem.dim * problem.dim * sizeof(double);
}

// n m² operations for m entries a column: beyond 900 of them a factor takes 3 s and more of a body of linear cells in
// space, whose way to rest takes a tenth of that; in the plane there are as many for none but cubic functions.
bool factor_is_cheap(const Problem& problem, const BodySize& size) {
  constexpr double many = 900;
  return entries_of_factor(problem, size) <= many * size.unknowns;
}

bool has_room_for_factor(const Problem& problem) {
  constexpr double most_entries = std::numeric_limits<int>::max();  // that CHOLMOD numbers
  const BodySize size = body_size(problem);
  if (entries_of_factor(problem, size) > most_entries) return false;
  return bytes_of_assembly(problem, size) + 2 * bytes_of_matrix(problem, size) + bytes_of_factor(problem, size) <=
         memory_room().bytes;
}

}  // namespace stillpoint
