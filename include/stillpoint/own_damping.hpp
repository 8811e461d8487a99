// User-defined damping forces, which scenes name like the built-in ones.
//
//   add_damping({.name = "quadratic", .equation = "M a = Q - alpha |v| v"},
//               [](double alpha, ConstVec v, ConstVec Q, Vec D) { … D[i] = −alpha |v_i| v_i … });
#pragma once

#include <stillpoint/types.hpp>

#include <functional>
#include <string>

namespace stillpoint {

struct OwnDamping {
  std::string name;  // value of damping.strategy: lower-case letters, digits and hyphens
  std::string equation{}, source{};
  /// The largest |Q + D|/|Q|, the factor by which the critical step takes the stiffness to grow. A D that is not
  /// proportional to Q counts as 1, and the program has to choose the step.
  double stiffness_factor = 1;
};

/// D(v, Q) [N] with alpha from the scene, D_i of v_i and Q_i alone; v, Q, D: (n), all free degrees of freedom at once,
/// or some oscillators by which the critical step is found. An exception ends the step and reaches the caller.
using OwnDampingForce = std::function<void(double alpha, ConstVec v, ConstVec Q, Vec D)>;

/// Registers a damping: damping.strategy = name is M a = Q + D from now on. It replaces a damping of that name added
/// before; scenes loaded earlier keep theirs. Throws std::invalid_argument if the name is malformed, or one of this
/// library's.
void add_damping(const OwnDamping& about, OwnDampingForce force);

}  // namespace stillpoint
