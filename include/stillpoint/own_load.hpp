// A body force of a program's own, which scenes then name: [body_force] own = "name".
//
//   add_load({.name = "centrifugal"}, [](double, int dim, ConstVec x, Vec b) {
//     for (std::size_t i = 0; i < x.size(); ++i) b[i] = omega * omega * x[i];
//   });
#pragma once

#include <stillpoint/types.hpp>

#include <functional>
#include <string>

namespace stillpoint {

struct OwnLoad {
  std::string name;  // of body_force.own: lower-case letters, digits and hyphens
  /// From when on it is what it will be at the end [s]: no equilibrium is found before. 0: it depends on position
  /// alone, and is asked once a phase; infinity: it may change until stop.time.
  double settles_at = 0;
};

/// b(x, t) [m/s²], the force per mass, at t [s] and at the positions x [m] that all points have as the phase begins;
/// x, b: (points × dim), row by row, the points in any order. What it throws ends the step and reaches the caller.
using OwnBodyForce = std::function<void(double t, int dim, ConstVec x, Vec b)>;

/// From now on body_force.own = name adds b to body_force.value. In the place of one of that name that was added
/// before; simulations that were set up keep theirs. Throws std::invalid_argument if the name is no word, or settles_at
/// is negative or no number.
void add_load(const OwnLoad& about, OwnBodyForce b);

}  // namespace stillpoint
