// A damping force of a program's own, which scenes then name like any other.
//
//   add_damping({.name = "quadratic", .equation = "M a = Q - alpha |v| v"},
//               [](double alpha, ConstVec v, ConstVec Q, Vec D) { … D[i] = −alpha |v_i| v_i … });
#pragma once

#include <stillpoint/types.hpp>

#include <functional>
#include <string>

namespace stillpoint {

struct OwnDamping {
  std::string name;  // of damping.strategy: lower-case letters, digits and hyphens
  std::string equation{}, source{};
  /// The largest |Q + D|/|Q|: by this the critical step sees the stiffness grow. A D that is no share of Q counts as 1,
  /// and the step is the program's to choose.
  double stiffness_factor = 1;
};

/// D(v, Q) [N] with alpha of the scene; v, Q, D: (n), all free degrees of freedom at once, or (1) where the critical
/// step is looked for. What it throws ends the step and reaches the caller.
using OwnDampingForce = std::function<void(double alpha, ConstVec v, ConstVec Q, Vec D)>;

/// From now on damping.strategy = name is M a = Q + D. In the place of one of that name that was added before; scenes
/// that were loaded keep theirs. Throws std::invalid_argument if the name is no word, or one of this library's.
void add_damping(const OwnDamping& about, OwnDampingForce force);

}  // namespace stillpoint
