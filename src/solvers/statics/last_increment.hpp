// How a body that remembers its path went in the last increment of its load: where the next one begins.
//
// Points that yield lie on their yield surface when the load is increased, and resist the first step as elastic ones
// do: that step leads far from where they would flow to. Going on as they did in the last increment, they flow.
#pragma once

#include <stillpoint/types.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace stillpoint {

class LastIncrement {
 public:
  bool is_known() const { return !way_.empty(); }
  /// It led from u_begin to u, with this share of the load.
  void remember(double share, ConstVec u_begin, ConstVec u) {
    share_ = share;
    way_.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) way_[i] = u[i] - u_begin[i];
  }
  /// u goes on likewise, by another share of the load.
  void extrapolate(double share, Vec u) const {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += share / share_ * way_[i];
  }
  /// Whether u_begin to u is no further than a few times as far for its share: what is far away lies beyond a limit
  /// load.
  bool is_like(double share, ConstVec u_begin, ConstVec u) const {
    constexpr double most = 4;
    double went = 0, before = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      went += (u[i] - u_begin[i]) * (u[i] - u_begin[i]);
      before += way_[i] * way_[i];
    }
    return std::sqrt(went) <= most * share / share_ * std::sqrt(before);
  }

 private:
  std::vector<double> way_;
  double share_ = 0;
};

}  // namespace stillpoint
