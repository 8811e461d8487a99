// The way of a static solver: the work along it, on which loads and supports come on in shares s from 0 to 1.
//
//   W = ∫ F_s · du + ∫ R_s · du_s,   F_s = R in equilibrium,   u_s = s U_s
//
// by the trapezoidal rule from one equilibrium to the next: of full loads from the start it would be twice as large in
// an elastic body. U_s, how far supports go, is a matter of the caller.
#pragma once

#include <stillpoint/state_archive.hpp>
#include <stillpoint/stepper.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <vector>

#include "base/parallel_loop.hpp"

namespace stillpoint {

class StaticWay {
 public:
  /// Begins at u, or goes on there after a change of forces. share: of their way that supports have gone; R, u: (n);
  /// reactions: (supports).
  void begin(double share, ConstVec R, ConstVec reactions, ConstVec u) {
    share_ = share;
    R_.assign(R.begin(), R.end());
    u_.assign(u.begin(), u.end());
    reactions_.assign(reactions.begin(), reactions.end());
    so_far_.reactions.resize(reactions.size());
  }
  /// Goes on to the next equilibrium.
  void go_on(double share, ConstVec R, ConstVec reactions, ConstVec u) {
    so_far_ = up_to(share, R, reactions, u);
    begin(share, R, reactions, u);
  }

  const Stepper::Way& so_far() const { return so_far_; }
  /// The same up to a state that is none yet; nothing more if it has not begun, at a state that cannot be evaluated.
  Stepper::Way up_to(double share, ConstVec R, ConstVec reactions, ConstVec u) const {
    Stepper::Way way = so_far_;
    if (R_.size() != u.size() || reactions_.size() != reactions.size()) return way;
    way.of_loads += sum_over(
        u.size(), [=, R0 = R_.data(), u0 = u_.data()](std::size_t i) { return 0.5 * (R0[i] + R[i]) * (u[i] - u0[i]); });
    for (std::size_t s = 0; s < reactions.size(); ++s)
      way.reactions[s] += 0.5 * (reactions_[s] + reactions[s]) * (share - share_);
    return way;
  }

  /// n, supports: the sizes in the system that it is of.
  void archive(const StateArchive& state, std::size_t n, std::size_t supports) {
    state("share", share_, "of_loads", so_far_.of_loads);
    state.none_or(n, "R", R_);
    const bool has_begun = n == 0 || !R_.empty();
    u_.resize(R_.size());
    for (auto* of_supports : {&reactions_, &so_far_.reactions}) of_supports->resize(has_begun ? supports : 0);
    state("u", Vec(u_));
    state("reactions", Vec(reactions_));
    state("reactions_so_far", Vec(so_far_.reactions));
  }

 private:
  Stepper::Way so_far_;
  double share_ = 0;
  std::vector<double> R_, u_, reactions_;  // at the last equilibrium
};

}  // namespace stillpoint
