// The way that a body which creeps would still go, estimated from the way that it has come.
//
// If points yield or slide neither the residual nor a tangent tells how far it is to rest: next to its limit a body
// moves on for long with next to nothing out of balance. So the motion itself is looked at, as the mean positions over
// blocks of time, in which what vibrates averages out. With d₁ and d₂ the largest ways of a point over two spans of
// time that follow each other, and their velocities v₁ and v₂,
//
//   the last two blocks       v = v₂ e^{−(t − t₂)/τ},  τ = (t₂ − t₁)/ln(v₁/v₂):   way left  v₂ τ
//   the last half of all the time since the loads came to their end, and the quarter before it
//                             v = v₂ (t/t₂)^{−q},  q = ln(v₁/v₂)/ln(t₂/t₁):       way left  v t/(q − 1), if q > 1
//
// and the larger one counts: the first sees a motion that sets in, the second one that dies out more slowly than it
// seems. A motion that does not die out has no end that could be told.
#pragma once

#include <stillpoint/state_archive.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <deque>
#include <vector>

namespace stillpoint {

class WayLeft {
 public:
  /// small: the way left, relative to the largest displacement, that counts as none. A fifth of it, gone in either
  /// span, is taken for rest, since the velocities of what hardly moves are chance.
  explicit WayLeft(double small) : small_(small) { begin(0); }

  /// Begins anew at t, from which on the loads stay what they are.
  void begin(double t);
  /// x: mean displacements since the start of the run over a block of time around t, (points × dim).
  void add(double t, std::size_t dim, ConstVec x);

  /// Relative to the largest displacement; infinite before there are three blocks, and of a motion that goes on.
  double relative() const { return relative_; }
  double small() const { return small_; }
  /// The exponent q of a motion that goes on, 0 if its velocity is constant; infinite for others, and if not known yet.
  double exponent() const { return exponent_; }
  /// The span over which that was looked at [s], and the largest way of a point in it [m].
  double span() const { return span_; }
  double way() const { return way_; }
  /// And of each point's components the mean velocity in it, (points × dim) [m/s].
  std::vector<double> velocities() const;

  /// The number of coordinates of the last block, points × dim; 0: there is none.
  std::size_t size_of_block() const { return last_.empty() ? 0 : last_.back().x.size(); }
  void archive(const StateArchive& state);

 private:
  struct Block {
    double t = 0;
    std::vector<float> x;
  };
  double from_last_blocks(double size) const;
  double from_the_whole(double size);
  const Block& nearest(double t) const;
  double apart(const Block& a, const Block& b) const;

  double small_, begun_ = 0;
  std::size_t dim_ = 1;
  long count_ = 0, next_kept_ = 1;
  std::deque<Block> last_, kept_;  // the last three; some of all, in a geometric progression
  double relative_, exponent_, span_ = 0, way_ = 0;
  double half_way_t_ = 0;  // time of the block from which the span begins [s]
};

}  // namespace stillpoint
