// User-defined body forces, which scenes name: [body_force] own = "name".
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
  std::string name;  // value of body_force.own: lower-case letters, digits and hyphens
  /// The time from which on the force is final [s]: no equilibrium is found before. 0: it depends on position alone,
  /// and is evaluated once a phase; infinity: it may change until stop.time.
  double settles_at = 0;
};

/// b(x, t) [m/s²], the force per mass, at t [s] and at the positions x [m] that all points have when the phase begins;
/// x, b: (points × dim), row by row, the points in any order. An exception ends the step and reaches the caller.
using OwnBodyForce = std::function<void(double t, int dim, ConstVec x, Vec b)>;

/// Registers a body force: body_force.own = name adds b to body_force.value from now on. It replaces a force of that
/// name added before; simulations set up earlier keep theirs. Throws std::invalid_argument if the name is malformed, or
/// settles_at is negative or NaN.
void add_load(const OwnLoad& about, OwnBodyForce b);

}  // namespace stillpoint
