// The lowest mode of a tangent that need not be positive definite.
#pragma once

#include <stillpoint/mass.hpp>

#include <functional>
#include <vector>

namespace stillpoint {

/// λ and x of K x = λ M x with the smallest λ, xᵀMx = 1.
struct LowestMode {
  bool positive_definite = false;  // by more than rounding: then λ and x are not looked for
  bool found = false;
  double omega_squared = 0;  // λ
  double rounding = 0;       // of λ: that of the entries of K
  std::vector<double> x{};   // (n)
};

/// K: symmetric. One factorisation of K if it is positive definite; a few of K + σM, σ > −λ, if not. is_left_out(x):
/// whether a mode does not count, so that the lowest of the others is looked for; not found if a dozen do not.
LowestMode lowest_mode(const SparseMatrix& K, const Mass& mass,
                       const std::function<bool(const std::vector<double>& x)>& is_left_out = {});

}  // namespace stillpoint
