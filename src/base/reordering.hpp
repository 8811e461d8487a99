// The rearrangement of arrays after their entries are sorted anew.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/parallel_loop.hpp"

namespace stillpoint {

/// The entry from()[k] becomes entry k. If most entries stay in their places, only the ranges with the others are
/// copied.
class Reordering {
 public:
  /// Called once `from` is complete; finds the ranges that move.
  void complete() {
    moved_.clear();
    std::size_t others = 0;
    for (std::size_t k = 0; k < from_.size(); ++k) {
      if (from_[k] == static_cast<int>(k)) continue;
      if (moved_.empty() || k - moved_.back().second > gap) moved_.emplace_back(k, k);
      moved_.back().second = k + 1;
    }
    for (const auto& [begin, end] : moved_) others += end - begin;
    in_place_ = 2 * others < from_.size();
  }
  std::vector<int>& from() { return from_; }
  const std::vector<int>& from() const { return from_; }

  /// Rearranges values, (rows × count): rows that hold the entries begin … begin + count − 1 alone, which are permuted
  /// among themselves. work: takes the size of values.
  template <class T>
  void apply(std::vector<T>& values, std::vector<T>& work, std::size_t begin, std::size_t count) const {
    if (values.empty() || moved_.empty()) return;
    work.resize(values.size());
    for (std::size_t row = 0; row < values.size(); row += count) {
      T* const of_row = values.data() + row;
      T* const taken = work.data() + row;
      const auto take = [of_row, taken, begin, from = from_.data() + begin](std::size_t k) {
        taken[k] = of_row[static_cast<std::size_t>(from[k]) - begin];
      };
      if (!in_place_) {
        for_each_index(count, take);
        continue;
      }
      const auto for_moved = [&](const auto& visit) {
        for_each_block(moved_.size(), [&](std::size_t range) {
          const std::size_t low = std::max(moved_[range].first, begin);
          const std::size_t high = std::min(moved_[range].second, begin + count);
          if (low < high) visit(low - begin, high - begin);
        });
      };
      for_moved([&](std::size_t low, std::size_t high) {
        for (std::size_t k = low; k < high; ++k) take(k);
      });
      for_moved([&](std::size_t low, std::size_t high) { std::copy(taken + low, taken + high, of_row + low); });
    }
    if (!in_place_) values.swap(work);
  }
  template <class T>
  void apply(std::vector<T>& values, std::vector<T>& work) const {
    apply(values, work, 0, from_.size());
  }

 private:
  static constexpr std::size_t gap = 8;  // entries in place that are copied with those around them

  std::vector<int> from_;
  std::vector<std::pair<std::size_t, std::size_t>> moved_;  // ranges outside which all entries stay
  bool in_place_ = false;
};

}  // namespace stillpoint
