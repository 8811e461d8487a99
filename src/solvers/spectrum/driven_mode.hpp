// The motion that no stiffness resists and that a force drives: it shows that a body is not held.
#pragma once

#include <stillpoint/mass.hpp>

#include <vector>

namespace stillpoint {

/// A motion x with K x = 0 and xᵀMx = 1.
struct DrivenMode {
  bool found = false;
  double share = 0;         // share of the force, x·Q/√(QᵀM⁻¹Q), 0 to 1; a rounding error if nothing drives it
  std::vector<double> x{};  // (n)
};

/// Among all such motions the one that Q drives most: the projection of M⁻¹Q onto them, by inverse iteration with
/// K + σM from M⁻¹Q, in which motions without stiffness grow. Not found if K is regular or not positive semidefinite.
/// K: symmetric; Q: (n).
DrivenMode driven_mode(const SparseMatrix& K, const Mass& mass, ConstVec Q);

}  // namespace stillpoint
