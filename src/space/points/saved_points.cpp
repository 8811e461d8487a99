#include "space/points/saved_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace stillpoint {
namespace {

using Numbers = std::vector<std::int64_t>;

/// Null if there is none, or one of another kind, which restoring reports.
const Numbers* numbers_of(const SavedState& saved, const char* name) {
  const auto found = saved.find(name);
  return found == saved.end() ? nullptr : std::get_if<Numbers>(&found->second);
}

bool are_sorted(const Numbers& cell, const Numbers& cell_begin, std::int64_t n, std::int64_t cells) {
  return cell_begin.size() == cell.size() + 1 && cell_begin.front() == 0 && cell_begin.back() == n &&
         std::ranges::adjacent_find(cell_begin, std::ranges::greater_equal()) == cell_begin.end() &&
         std::ranges::all_of(cell, [cells](std::int64_t c) { return c >= 0 && c < cells; });
}

bool are_numbered(Numbers number, std::int64_t n) {
  std::ranges::sort(number);
  return std::ssize(number) == n && (n == 0 || (number.front() == 0 && number.back() == n - 1)) &&
         std::ranges::adjacent_find(number) == number.end();
}

bool is_position(const std::string& name) {
  return name.starts_with("phase/x_") || name.starts_with("phase/corner_") || name.starts_with("phase/half_");
}

}  // namespace

std::string fault_of_saved_points(const SavedState& saved, std::int64_t n, std::int64_t cells) {
  const Numbers *const cell = numbers_of(saved, "phase/cell"), *const begin = numbers_of(saved, "phase/cell_begin");
  const Numbers* const number = numbers_of(saved, "phase/number");
  if (cell && begin && !are_sorted(*cell, *begin, n, cells))
    return "its points are not sorted by the cells of the grid";
  if (number && !are_numbered(*number, n)) return "its points are not numbered";
  for (const auto& [name, value] : saved) {
    const auto* const positions = std::get_if<std::vector<double>>(&value);
    if (positions && is_position(name) && !std::ranges::all_of(*positions, [](double x) { return std::isfinite(x); }))
      return "'" + name + "' is not finite";
  }
  return "";
}

}  // namespace stillpoint
