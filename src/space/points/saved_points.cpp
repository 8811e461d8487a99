#include "space/points/saved_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "space/points/point_order.hpp"

namespace stillpoint {
namespace {

bool are_sorted(const std::vector<int>& cell, const std::vector<int>& cell_begin, std::size_t n, long cells) {
  return cell_begin.size() == cell.size() + 1 && cell_begin.front() == 0 && cell_begin.back() == static_cast<int>(n) &&
         std::ranges::adjacent_find(cell_begin, std::ranges::greater_equal()) == cell_begin.end() &&
         std::ranges::all_of(cell, [cells](int c) { return c >= 0 && c < cells; });
}

bool are_numbered(const std::vector<int>& number, std::size_t n, std::size_t numbers) {
  std::vector<char> has_point(numbers);
  for (const int k : number) {
    if (k < 0 || static_cast<std::size_t>(k) >= numbers) return false;
    has_point[static_cast<std::size_t>(k)] = 1;
  }
  return number.size() == n && std::ranges::find(has_point, 0) == has_point.end();
}

bool are_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
}

}  // namespace

template <int Dim>
void archive_points(const StateArchive& state, MaterialPoints<Dim>& points) {
  for (int d = 0; d < Dim; ++d) {
    state(fmt::format("x_{}", d), Vec(points.x[d]));
    state(fmt::format("v_{}", d), Vec(points.v[d]));
  }
  for (std::size_t ij = 0; ij < points.B_apic.size(); ++ij) state(fmt::format("B_{}", ij), Vec(points.B_apic[ij]));
  if (points.has_domains()) {
    for (std::size_t c = 0; c < points.corner.size(); ++c) state(fmt::format("corner_{}", c), Vec(points.corner[c]));
    for (std::size_t d = 0; d < points.half.size(); ++d) {
      state(fmt::format("half_{}", d), Vec(points.half[d]));
      state(fmt::format("rest_{}", d), Vec(points.rest[d]));
    }
  }
  state("volume", Vec(points.volume));
  state("mass", Vec(points.mass));
  state("number", points.number);
  state("cell", points.cell);
  state("cell_begin", points.cell_begin);
}

template <int Dim>
std::vector<int> archive_number_of_points(const StateArchive& state, MaterialPoints<Dim>& points) {
  const std::vector<int> before = points.material_begin;
  state("material_begin", points.material_begin);
  if (points.material_begin.size() != before.size() || points.material_begin.front() != 0 ||
      !std::ranges::is_sorted(points.material_begin))
    throw StateError("'material_begin' is not that of the materials of this scene");
  if (points.material_begin == before) return {};
  std::vector<int> number;
  state("number", number);
  if (number.size() != static_cast<std::size_t>(points.material_begin.back()))
    throw StateError("'material_begin' is not that of its points");
  std::vector<int> from;
  for (std::size_t m = 0; m + 1 < before.size(); ++m)
    from.resize(static_cast<std::size_t>(points.material_begin[m + 1]), before[m]);
  take_points(points, from);
  return from;
}

template <int Dim>
std::string disorder_of(const MaterialPoints<Dim>& points, long cells, std::size_t numbers) {
  if (!are_sorted(points.cell, points.cell_begin, points.size(), cells))
    return "its points are not sorted by the cells of the grid";
  if (!are_numbered(points.number, points.size(), numbers)) return "its points are not numbered";
  const bool finite = std::ranges::all_of(points.x, are_finite) && std::ranges::all_of(points.corner, are_finite) &&
                      std::ranges::all_of(points.half, are_finite);
  return finite ? "" : "a position is not finite";
}

template void archive_points(const StateArchive&, MaterialPoints<1>&);
template void archive_points(const StateArchive&, MaterialPoints<2>&);
template void archive_points(const StateArchive&, MaterialPoints<3>&);
template std::vector<int> archive_number_of_points(const StateArchive&, MaterialPoints<1>&);
template std::vector<int> archive_number_of_points(const StateArchive&, MaterialPoints<2>&);
template std::vector<int> archive_number_of_points(const StateArchive&, MaterialPoints<3>&);
template std::string disorder_of(const MaterialPoints<1>&, long, std::size_t);
template std::string disorder_of(const MaterialPoints<2>&, long, std::size_t);
template std::string disorder_of(const MaterialPoints<3>&, long, std::size_t);

}  // namespace stillpoint
