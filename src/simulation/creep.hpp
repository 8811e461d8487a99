// Whether a body that yields, or slides on a wall, is on its way to rest, and how far it would still go.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "simulation/giving_way.hpp"
#include "simulation/setup/model.hpp"
#include "simulation/way_left.hpp"

namespace stillpoint {

class Creep {
 public:
  /// All outlive it.
  Creep(const Problem& problem, const Model& model, const GivingWay& giving_way);

  /// Whether it wants a sample: four times in a block of time, a period of the body.
  bool due(double t) const { return watches_ && t >= next_; }
  /// At (t, u). settled: whether the loads are what they will be at the end.
  void sample(double t, ConstVec u, bool settled);
  /// The longest period [s], if it shows on the way, at t. One that is longer than half of the run so far may be noise.
  void set_period(double period, double t) { period_ = std::min(period, std::max(shortest_period_, t / 2)); }

  /// Relative to the largest displacement; infinite if it is not known, as the motion does not die out. Empty: nothing
  /// has yielded or slid yet.
  std::optional<double> way_left() const;
  /// How much of that equilibrium takes.
  double allowed() const { return way_left_.small(); }
  /// "it slides: …", at (t, u); empty if it does not, or nobody knows.
  std::string description(double t, ConstVec u) const;
  /// Whether that has gone on for long enough, and over more than a cell in a single phase: a motion that nothing
  /// stops.
  bool slides_away() const;

  void archive(const StateArchive& state);

 private:
  bool loads_have_changed(double t) const;
  bool slides() const;
  void begin_block(double t);
  void close_block();

  const Problem& problem_;
  const LagrangianPhase& phase_;
  const GivingWay& giving_way_;
  WayLeft way_left_;
  bool watches_, may_slide_away_;
  double period_ = 0, shortest_period_ = 0, cell_ = 0;
  std::size_t stride_ = 1;   // of the points that are looked at
  std::vector<double> sum_;  // of their displacements over the block, (points × dim) [m]
  double samples_ = 0, sum_t_ = 0, block_end_ = 0, next_ = 0, last_t_ = 0;
  double plastic_strain_ = 0;
  bool begun_ = false, has_given_ = false, gives_ = false;  // gives: in the last block
  bool slid_ = false;                                       // in this one
  double steady_since_ = -1;  // the time from which on the motion gives way and does not slow down [s]; negative: none
  double begun_at_ = 0;
};

}  // namespace stillpoint
