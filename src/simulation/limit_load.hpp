// The limit load: the factor λ that driven loads have when it does not grow any more with their displacement q.
//
//   m = (q − q₀)/(λ − λ₀) dλ/dq,   over the last fifth of q(t)
//
// is 1 of an elastic body, whatever its stiffness, 0 at the limit, and negative beyond a peak. q₀ and λ₀ are those of
// the last step before q(t) begins, what other loads have done.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "space/boundary/load_state.hpp"

namespace stillpoint {

class LimitLoad {
 public:
  // Of ‖F − R‖/‖F‖: with more out of balance λ is not what the body bears, but what accelerates it.
  static constexpr double largest_residual = 1e-3;
  // As it grows from there q(t) has to show no more growth of λ: a swing, or the waves of a start, are no limit.
  static constexpr double confirmed_after = 1.25;

  /// growth: m at the limit; 0: nobody asks for it.
  explicit LimitLoad(double growth) : asked_(growth) {}

  /// After a step. Whether m is known anew and small enough, so that reached() is to be asked.
  bool observe(const LoadState& load);
  /// residual: ‖F − R‖/‖F‖ of the same moment.
  bool reached(double residual) const { return residual <= largest_residual; }  // false for NaN as well
  /// m; nothing before there is enough of q.
  std::optional<double> growth() const { return growth_; }
  /// "over the last fifth of the displacement …".
  std::string description() const;

  void archive(const StateArchive& state);

 private:
  void close_piece();
  void halve();
  std::optional<double> measured_growth() const;

  double asked_;
  double first_q_ = 0, first_factor_ = 0;
  double flat_since_ = 0;  // the q(t) from which on m is small enough [m]; 0: it is not
  // Means over the steps within each piece of q(t), the pieces one after the other and of about the same length.
  std::vector<double> q_, factor_;
  double piece_ = 0;                                         // this length [m]; 0 before q(t) has begun
  double steps_ = 0, sum_q_ = 0, sum_factor_ = 0, end_ = 0;  // of the open piece
  std::optional<double> growth_;
};

}  // namespace stillpoint
