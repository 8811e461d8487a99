#include "space/points/saved_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

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
std::string disorder_of(const MaterialPoints<Dim>& points, long cells, std::size_t numbers) {
  if (!are_sorted(points.cell, points.cell_begin, points.size(), cells))
    return "its points are not sorted by the cells of the grid";
  if (!are_numbered(points.number, points.size(), numbers)) return "its points are not numbered";
  const bool finite = std::ranges::all_of(points.x, are_finite) && std::ranges::all_of(points.corner, are_finite) &&
                      std::ranges::all_of(points.half, are_finite);
  return finite ? "" : "a position is not finite";
}

template std::string disorder_of(const MaterialPoints<1>&, long, std::size_t);
template std::string disorder_of(const MaterialPoints<2>&, long, std::size_t);
template std::string disorder_of(const MaterialPoints<3>&, long, std::size_t);

}  // namespace stillpoint
