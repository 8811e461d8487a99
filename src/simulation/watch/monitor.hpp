// The stopping tests that a scene or a program asks for: equilibrium, which is rest and balance for a whole period, the
// limits of time and steps, and options.stop_test.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "simulation/watch/creep.hpp"

namespace stillpoint {

struct MonitorOptions {
  double residual = 0;            // ‖F − R‖/‖F‖; 0: no test of it
  double distance = 0;            // the error bound, relative; 0: no test of it. Without either there is no equilibrium
  bool distance_is_asked = true;  // whether a distance that is not known counts as far
  double kinetic_energy = 0;      // share of the largest kinetic energy so far; 0: only the others count
  double dwell = 0;               // all held for this long [s]: a kinetic energy alone is small at every turning point
  /// True if balance has to last. Otherwise the residual bounds the error, and the dwell says how often to test.
  bool must_last = true;
  double end_time = 0;  // [s]; 0: none
  long steps = 0;       // 0: no limit
  double begin = 0;     // the time at which the run begins [s]
};

class Monitor : public Watcher {
 public:
  explicit Monitor(const MonitorOptions& options)
      : options_(options), shortest_dwell_(options.dwell), next_check_(options.dwell / checks_a_dwell) {}
  /// creep outlives this object, and learns from it the period that shows on the way.
  Monitor(const RunState& run, Creep& creep);

  Verdict judge(RunState& run) override;
  void archive(const StateArchive& state, RunState& run) override;

  /// The dwell from now on, at t [s], if a period of the slowest motion shows on the way. One that is longer than half
  /// of the run so far has not been seen yet, and may be noise: the dwell is no longer than that, nor is the next test
  /// further away than a 32nd of it; but both are as long as they were at the beginning.
  void set_dwell(double dwell, double t) {
    constexpr double longest_share = 0.5;
    options_.dwell = std::min(dwell, std::max(shortest_dwell_, longest_share * (t - options_.begin)));
  }
  /// The way that a body which yields or slides would still go, relative to its displacement, for the next
  /// check_balance(), and how much that may be. Empty: nothing yields or slides; infinite: the way is not known.
  void set_way_left(std::optional<double> way, double allowed) {
    way_left_ = way;
    allowed_way_ = allowed;
  }
  /// True if check_balance() wants residual and kinetic energy at t; in between, asking costs nothing.
  bool due(double t) const { return t >= next_check_; }
  /// Residual, kinetic energy [J] and a scale of the work done [J] at t [s]. A kinetic energy that is rounding beside
  /// the work counts as rest, also in a body that never moved.
  /// settled: whether the loads are what they will be at the end; before, balance is none.
  /// distance: if there is a test of it; unknown counts as far. moves: false of an iterate without a motion, whose
  /// balance need not last.
  RunStatus check_balance(double t, double residual, double kinetic_energy, double work_scale = 0, bool settled = true,
                          std::optional<double> distance = std::nullopt, bool moves = true);
  /// The limits that do not need the state; call after every step.
  RunStatus check_limits(double t, long steps);

  /// The condition beside the residual that the last check_balance() missed, "kinetic energy 0.2 > 0.01 …"; empty:
  /// none.
  const std::string& waits_for() const { return waits_for_; }
  /// The inequality that ended the run.
  const std::string& reason() const { return reason_; }

 private:
  static constexpr int checks_a_dwell = 16;

  Verdict test_equilibrium(RunState& run);
  void follow_period(const RunState& run);
  std::string missing(bool settled, bool near, std::optional<double> distance, bool creeps) const;

  Creep* creep_ = nullptr;  // null: nobody learns the period
  MonitorOptions options_;
  double shortest_dwell_;
  double next_check_;
  double balanced_since_ = -1;  // [s]; negative: not in balance
  double peak_kinetic_energy_ = 0;
  std::optional<double> way_left_;
  double allowed_way_ = 0;
  std::string reason_, waits_for_;
};

}  // namespace stillpoint
