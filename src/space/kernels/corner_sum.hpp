// A deterministic scatter: values are summed by cell corner first, and the corners by grid function in a fixed order,
// so that the bits do not depend on the number of threads.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <vector>

#include "base/lanes.hpp"

namespace stillpoint {

class CornerSum {
 public:
  /// function_of_corner: the grid function of each corner, (cells × per_cell); functions: their number in the grid.
  void rebuild(const std::vector<int>& function_of_corner, std::size_t functions) {
    begin_.assign(functions + 1, 0);
    for (const int function : function_of_corner) ++begin_[static_cast<std::size_t>(function) + 1];
    for (std::size_t f = 0; f < functions; ++f) begin_[f + 1] += begin_[f];
    corner_.resize(function_of_corner.size());
    next_.assign(begin_.begin(), begin_.end() - 1);
    for (std::size_t c = 0; c < function_of_corner.size(); ++c) {
      corner_[static_cast<std::size_t>(next_[static_cast<std::size_t>(function_of_corner[c])]++)] = static_cast<int>(c);
    }
  }
  std::size_t functions() const { return begin_.size() - 1; }  // 0 before the first rebuild
  bool reaches(std::size_t function) const { return begin_[function] < begin_[function + 1]; }

  /// Calls visit(corner) for a function's corners, in the order of cells.
  template <class Visit>
  void for_corners(std::size_t function, const Visit& visit) const {
    for (int c = begin_[function]; c < begin_[function + 1]; ++c) visit(corner_[static_cast<std::size_t>(c)]);
  }

  /// Numbers after the last that sum() may read.
  static constexpr std::size_t slack = 1;

  /// The sum of values, (corners × Components + slack), over the corners of a function; [i] is component i.
  template <int Components>
  auto sum(std::size_t function, const double* values) const {
    const auto values_of = [&](int c) {
      return values + Components * static_cast<std::ptrdiff_t>(corner_[static_cast<std::size_t>(c)]);
    };
    constexpr bool is_register = std::has_single_bit(static_cast<unsigned>(Components));
    if constexpr (!is_register && Components != 3) {
      std::array<double, Components> total{};
      for (int c = begin_[function]; c < begin_[function + 1]; ++c) {
        for (int i = 0; i < Components; ++i) total[i] += values_of(c)[i];
      }
      return total;
    } else {
      // Of three, a fourth number is summed for nobody.
      using Sum = Lanes<static_cast<int>(std::bit_ceil(static_cast<unsigned>(Components)))>;
      Sum total{};
      for (int c = begin_[function]; c < begin_[function + 1]; ++c) total = total.plus(Sum::load(values_of(c)));
      return total;
    }
  }

 private:
  std::vector<int> begin_{0};  // (functions + 1)
  std::vector<int> corner_;    // corners of function f at [begin_[f], begin_[f + 1])
  std::vector<int> next_;      // work array
};

}  // namespace stillpoint
