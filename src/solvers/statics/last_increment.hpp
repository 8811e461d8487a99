// The displacement over the last load increment of a history-dependent body, from which the next increment starts.
//
// Points that yield lie on their yield surface when the load is increased, and resist the first step elastically: that
// step leads far from where they would flow to. If they continue as in the last increment, they flow.
#pragma once

#include <stillpoint/types.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace stillpoint {

class LastIncrement {
 public:
  bool is_known() const { return !way_.empty(); }
  /// Keeps the increment from u_begin to u, which took this share of the load.
  void remember(double share, ConstVec u_begin, ConstVec u) {
    share_ = share;
    way_.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) way_[i] = u[i] - u_begin[i];
  }
  /// Moves u on by the last increment, scaled to another share of the load.
  void extrapolate(double share, Vec u) const {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += share / share_ * way_[i];
  }
  /// Whether the displacement from u_begin to u, relative to its share of the load, is at most a few times the last
  /// one: a state far away lies beyond a limit load.
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
