// What acts on a body over time: loads and moving supports, and whether they have come to their end.
#pragma once

#include <stillpoint/scene.hpp>
#include <stillpoint/semi_discrete.hpp>

#include <vector>

namespace stillpoint {

/// F(t) on the undeformed body, (n) [N].
std::vector<double> loads_at(const SemiDiscrete& system, double t);
/// Q(t) = F(t) − R(u = 0, t): loads and the force of displaced supports on the undeformed body, (n) [N].
std::vector<double> total_load_at(const SemiDiscrete& system, double t);

/// Tells a plateau of the loads from their end, so that equilibrium is not declared before a load has acted.
class LoadSchedule {
 public:
  /// For one phase. end_time 0: open; then every moment counts as the end.
  LoadSchedule(const Scene& scene, const SemiDiscrete& system, double end_time);
  /// Whether everything acts at t as it will at the end.
  bool settled(double t) const;

 private:
  std::vector<double> load(double t) const;

  const Scene& scene_;
  const SemiDiscrete& system_;
  double end_time_;
  bool supports_move_ = false;
  std::vector<double> at_end_;  // empty: nothing to wait for
};

}  // namespace stillpoint
