// A deterministic scatter: values are summed by cell corner first, and the corners by grid function in a fixed order,
// so that the bits do not depend on the number of threads, nor on that of ranks.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/lanes.hpp"
#include "base/parallel_loop.hpp"
#include "space/kernels/shared_corners.hpp"

namespace stillpoint {

class CornerSum {
 public:
  /// function_of_corner: the grid function of each corner, (cells × per_cell); functions: their number in the grid.
  /// ranks: that have a share of the cells each; places: those of this rank's cells, (cells), if there are ranks.
  void rebuild(const std::vector<int>& function_of_corner, std::size_t functions, const Ranks* ranks = nullptr,
               const std::vector<CellPlace>& places = {});
  std::size_t functions() const { return begin_.size() - 1; }  // 0 before the first rebuild
  /// Whether a cell has the function.
  bool reaches(std::size_t function) const {
    return shared_ ? shared_->reach(function) : begin_[function] < begin_[function + 1];
  }
  /// The number of corners of whose values there has to be room for, those of other ranks' cells among them.
  std::size_t corners() const { return corner_.size(); }

  /// Calls visit(function) for the functions that this rank has to sum, in parallel, once values at the corners,
  /// (corners × components + slack), are complete.
  template <class Visit>
  void for_functions(double* values, std::size_t components, const Visit& visit) const {
    if (!shared_) return for_each_block(functions(), visit);
    shared_->exchange(values, components);
    const std::span<const int> mine = shared_->functions();
    for_each_block(mine.size(), [&](std::size_t k) { visit(static_cast<std::size_t>(mine[k])); });
  }
  /// Completes sums at the functions, (functions × components), by those of other ranks. Returns whether these are
  /// good, each by what its rank says of its own.
  bool complete(double* sums, std::size_t components, bool is_good = true) const {
    return shared_ ? shared_->gather(sums, components, is_good) : is_good;
  }
  /// Sums values, (corners × Components + slack), at the functions, (functions × Components), with those of all ranks.
  /// Returns whether these are good, as complete() does.
  template <int Components>
  bool sum_at_functions(double* values, double* sums, bool is_good = true) const {
    for_functions(values, Components, [&](std::size_t f) {
      const auto total = sum<Components>(f, values);
      for (int i = 0; i < Components; ++i) sums[Components * f + i] = total[i];
    });
    return complete(sums, Components, is_good);
  }
  /// Where ranks share the cells; null: they do not.
  const SharedCorners* shared() const { return shared_.get(); }
  const Ranks* ranks() const { return ranks_; }

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
  std::size_t others() const { return shared_ ? shared_->others().size() : 0; }
  // Sorts the corners of functions that other ranks have as well by the places of their cells.
  void sort_corners(const std::vector<CellPlace>& places, std::size_t per_cell);

  std::vector<int> begin_{0};  // (functions + 1)
  std::vector<int> corner_;    // corners of function f at [begin_[f], begin_[f + 1])
  std::vector<int> next_;      // work array
  const Ranks* ranks_ = nullptr;
  std::unique_ptr<SharedCorners> shared_;
};

}  // namespace stillpoint
