// The position nearest to another one, of many that are asked for.
#pragma once

#include <stillpoint/types.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace stillpoint {

class NearestPosition {
 public:
  /// positions: (n × dim) [m], n > 0; outlives this.
  NearestPosition(ConstVec positions, std::size_t dim)
      : positions_(positions), dim_(dim), order_(positions.size() / dim) {
    double widest = -1;
    for (std::size_t d = 0; d < dim; ++d) {
      double low = positions[d], high = low;
      for (std::size_t i = d; i < positions.size(); i += dim) {
        low = std::min(low, positions[i]);
        high = std::max(high, positions[i]);
      }
      if (high - low > widest) widest = high - low, axis_ = d;
    }
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::sort(order_, {}, [this](std::size_t p) { return along(p); });
  }

  /// Its number; of several as near as each other the first.
  std::size_t to(const std::vector<double>& x) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    // False if all that lie beyond are further away.
    const auto look_at = [&](std::size_t p) {
      double square = 0;
      for (std::size_t d = 0; d < dim_; ++d) {
        const double distance = positions_[dim_ * p + d] - x[d];
        square += distance * distance;
      }
      if (square < least || (square == least && p < best)) least = square, best = p;
      const double distance = along(p) - x[axis_];
      return distance * distance <= least;
    };
    const auto here = std::ranges::lower_bound(order_, x[axis_], {}, [this](std::size_t p) { return along(p); });
    for (auto above = here; above != order_.end() && look_at(*above);) ++above;
    for (auto below = here; below != order_.begin() && look_at(*--below);) {
    }
    return best;
  }

 private:
  double along(std::size_t p) const { return positions_[dim_ * p + axis_]; }

  ConstVec positions_;
  std::size_t dim_, axis_ = 0;      // along which the positions spread most
  std::vector<std::size_t> order_;  // along it
};

}  // namespace stillpoint
