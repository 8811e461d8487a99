// Decides when a relaxation is over: at rest and in balance for a whole period, at an end, or gone wrong.
#pragma once

#include <stillpoint/state_archive.hpp>
#include <stillpoint/summary.hpp>

#include <optional>
#include <string>

namespace stillpoint {

struct MonitorOptions {
  double residual = 0;            // ‖F − R‖/‖F‖; 0: no test of it
  double distance = 0;            // the error bound, relative; 0: no test of it. Without either there is no equilibrium
  bool distance_is_asked = true;  // whether one that is not known counts as far
  double kinetic_energy = 0;      // share of the largest kinetic energy so far; 0: only the others count
  double dwell = 0;               // all held for this long [s]: a kinetic energy alone is small at every turning point
  /// Whether it has to last. If the residual bounds the error at every moment the dwell only says how often to test.
  bool must_last = true;
  double end_time = 0;  // [s]; 0: none
  long steps = 0;       // 0: no limit
};

class Monitor {
 public:
  explicit Monitor(const MonitorOptions& options) : options_(options), next_check_(options.dwell / checks_a_dwell) {}

  /// The dwell from now on [s], if a period of the slowest motion shows on the way.
  void set_dwell(double dwell) { options_.dwell = dwell; }
  /// Whether observe() wants residual and kinetic energy at t; in between, asking costs nothing.
  bool due(double t) const { return t >= next_check_; }
  /// Residual, kinetic energy [J] and a scale of the work done [J] at t [s]. A kinetic energy that is rounding beside
  /// the work counts as rest, also in a body that never moved.
  /// settled: whether the loads are what they will be at the end; before, balance is none.
  /// distance: if there is a test of it; unknown counts as far. moves: false of an iterate without a motion, whose
  /// balance need not last.
  RunStatus observe(double t, double residual, double kinetic_energy, double work_scale = 0, bool settled = true,
                    std::optional<double> distance = std::nullopt, bool moves = true);
  /// The limits that do not need the state; call after every step.
  RunStatus check_limits(double t, long steps);

  /// The inequality that ended the run.
  const std::string& reason() const { return reason_; }
  double peak_kinetic_energy() const { return peak_kinetic_energy_; }
  void archive(const StateArchive& state) {
    state("dwell", options_.dwell);
    state("next_check", next_check_);
    state("balanced_since", balanced_since_);
    state("peak_kinetic_energy", peak_kinetic_energy_);
  }

 private:
  static constexpr int checks_a_dwell = 16;

  MonitorOptions options_;
  double next_check_;
  double balanced_since_ = -1;  // [s]; negative: not in balance
  double peak_kinetic_energy_ = 0;
  std::string reason_;
};

}  // namespace stillpoint
