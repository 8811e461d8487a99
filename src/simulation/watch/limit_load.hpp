// The limit load: the factor λ that driven loads have when it does not grow any more with their displacement q.
//
//   m = (q − q₀)/(λ − λ₀) dλ/dq,   over the last fifth of q(t)
//
// is 1 in an elastic body, whatever its stiffness, 0 at the limit, and negative beyond a peak. q₀ and λ₀ are those of
// the last step before q(t) begins, what other loads have done.
//
// A small m alone is no limit: while a body is still set in motion λ is what accelerates it, and waves make it stand or
// fall for a while. So the motion has to be quasi-static meanwhile, its kinetic energy small beside the work
// W = ∫ λP dq of the driven loads; and the body has to give way, by points that yield or by sliding on a wall.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "simulation/watcher.hpp"
#include "space/boundary/condition_reports.hpp"

namespace stillpoint {

class LimitLoad : public Watcher {
 public:
  // The largest ‖F − R‖/‖F‖: with more out of balance λ is not what the body bears, but what accelerates it.
  static constexpr double largest_residual = 1e-3;
  // The growth of q(t) over which λ must not grow any more: a swing, or the waves of a start, are no limit.
  static constexpr double confirmed_after = 1.25;
  // The largest kinetic energy beside W. Footings on clay come to their limits with 1e-4.
  static constexpr double largest_inertia = 0.01;
  // The smallest share of the pieces of q(t) in the last fifth in which something gives way. It is not 1, since
  // vibrations unload points now and then.
  static constexpr double least_giving = 0.5;

  /// The body at the end of a piece of q(t).
  struct Body {
    double residual = 0;        // ‖F − R‖/‖F‖
    double kinetic_energy = 0;  // [J]
    double plastic_strain = 0;  // Σ_p V_p γᵖ_p, that only grows [m³]
    bool slides = false;        // whether it slides on a wall whose friction is used up
  };

  /// growth: m at the limit; 0: nobody asks for it.
  explicit LimitLoad(double growth) : asked_(growth) {}

  Verdict judge(RunState& run) override;
  void explain(RunState& run, Verdict& verdict) override;
  void archive(const StateArchive& state, RunState& run) override {
    archive(state);
    run.load_growth = growth_;
  }
  void archive(const StateArchive& state);

  /// A step; force: λP [N]. Whether a piece of q(t) is over, so that reached() is to be asked.
  bool take(const LoadState& load, double force);
  /// True if the body at that moment is at its limit. False if a figure is not a number.
  bool reached(const Body& body);
  /// m; nothing before there is enough of q.
  std::optional<double> growth() const { return growth_; }
  /// "over the last fifth of the displacement …", and if m is small enough and the limit not reached, why it is none.
  std::string description() const;

 private:
  void close_piece();
  void halve();
  std::size_t first_of_last_fifth() const { return q_.size() - q_.size() / 5; }
  std::optional<double> measured_growth() const;
  bool is_flat() const { return growth_ && *growth_ <= asked_; }
  double inertia() const;
  double giving() const;

  double asked_;
  double first_q_ = 0, first_factor_ = 0;
  double flat_since_ = 0;                          // the q(t) from which on m is small enough [m]; 0: it is not
  double last_q_ = 0, last_force_ = 0, work_ = 0;  // q [m] and λP [N] of the last step, W [J]
  double residual_ = 0, plastic_strain_ = 0;       // at the end of the last piece
  bool reached_ = false;
  // Means over the steps within each piece of q(t), the pieces one after the other and of about the same length.
  std::vector<double> q_, factor_;
  // The kinetic energy at the ends of the same pieces, and whether something gave way in them, 0 to 1.
  std::vector<double> kinetic_energy_, giving_;
  double piece_ = 0;                                         // this length [m]; 0 before q(t) has begun
  double steps_ = 0, sum_q_ = 0, sum_factor_ = 0, end_ = 0;  // steps, sums and end of the open piece
  std::optional<double> growth_;
};

}  // namespace stillpoint
