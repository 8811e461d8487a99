// The numbers of the grid's functions before and after the grid has followed a wall: it is given lines there, or loses
// some, and all other functions stay where they were.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace stillpoint {

/// A function that was not there before.
inline constexpr std::size_t no_function = static_cast<std::size_t>(-1);

/// The number that each function had before. before, now: the functions along the axes; at_end: whether the wall is at
/// the upper end of its axis.
template <std::size_t Dim>
std::vector<std::size_t> numbers_before(const std::array<std::size_t, Dim>& before,
                                        const std::array<std::size_t, Dim>& now, bool at_end) {
  std::size_t functions = 1;
  for (const std::size_t along : now) functions *= along;
  std::vector<std::size_t> from(functions, no_function);
  for (std::size_t f = 0; f < functions; ++f) {
    std::size_t left = f, stride = 1, old = 0;
    bool is_new = false;
    for (std::size_t d = 0; d < Dim; ++d) {
      const std::size_t index = left % now[d];
      const std::size_t was = at_end ? index : index + before[d] - now[d];  // too large if it is new
      is_new = is_new || was >= before[d];
      old += was * stride;
      left /= now[d];
      stride *= before[d];
    }
    if (!is_new) from[f] = old;
  }
  return from;
}

/// Values of the functions, so many each, in their new order; 0 where a function is new. from: numbers_before().
inline std::vector<double> renumbered(const std::vector<double>& values, const std::vector<std::size_t>& from,
                                      std::size_t each) {
  std::vector<double> now(each * from.size(), 0);
  for (std::size_t k = 0; k < now.size(); ++k)
    if (from[k / each] != no_function) now[k] = values[each * from[k / each] + k % each];
  return now;
}

}  // namespace stillpoint
