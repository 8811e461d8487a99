// Creep: a body that yields, or slides on a wall, moves on for long with next to nothing out of balance. This tells if
// it is on its way to rest, and how far it would still go.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "simulation/watch/way_left.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {

class Creep : public Watcher {
 public:
  /// The run outlives this object.
  explicit Creep(const RunState& run);

  /// Takes four samples in a block of time, which is a period of the body.
  void observe(RunState& run) override;
  /// The run is over if the body slides away.
  Verdict judge(RunState& run) override;
  void explain(RunState& run, Verdict& verdict) override;
  void archive(const StateArchive& state, RunState& run) override;

  /// The longest period [s], if it shows on the way, at t. One that is longer than half of the run so far may be noise.
  void set_period(double period, double t) { period_ = std::min(period, std::max(shortest_period_, t / 2)); }

 private:
  void sample(double t, ConstVec u, bool settled);
  void publish(RunState& run) const;
  bool loads_have_changed(double t) const;
  bool slides_away() const;
  std::string description(double t, ConstVec u) const;
  void begin_block(double t);
  void close_block();

  const Problem& problem_;
  const LagrangianPhase& phase_;
  std::size_t dim_;
  const GivingWay& giving_way_;
  WayLeft way_left_;
  bool watches_, may_slide_away_;
  double period_ = 0, shortest_period_ = 0, cell_ = 0;
  std::size_t stride_ = 1;   // every so many points one is looked at
  std::vector<double> sum_;  // the sum of their displacements over the block, (points × dim) [m]
  double samples_ = 0, sum_t_ = 0, block_end_ = 0, next_ = 0, last_t_ = 0;
  double plastic_strain_ = 0;               // Σ_p V_p γᵖ_p at the end of the last block [m³]
  bool begun_ = false;                      // whether there was a sample
  bool has_given_ = false, gives_ = false;  // whether the body gave way in any block, and in the last one
  bool slid_ = false;                       // whether it slid in this block
  std::vector<std::string> slid_along_;     // on what it slid when it was last seen to
  bool contact_is_settled_ = false;         // whether the multipliers of contact were settled at the last sample
  double steady_since_ = -1;  // the time from which on the motion gives way and does not slow down [s]; negative: none
  double steady_blocks_ = 0, giving_blocks_ = 0;  // blocks since then, and those in which it gave way
  double begun_at_ = 0;                           // the time from which on the loads have stayed [s]
};

}  // namespace stillpoint
