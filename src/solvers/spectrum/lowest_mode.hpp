// The lowest mode of a tangent that need not be positive definite.
#pragma once

#include <stillpoint/mass.hpp>

#include <functional>
#include <vector>

namespace stillpoint {

/// The smallest λ of K x = λ M x and its x, xᵀMx = 1.
struct LowestMode {
  bool positive_definite = false;  // by more than rounding: then λ and x are not looked for
  bool found = false;
  double omega_squared = 0;  // λ
  double rounding = 0;       // error of λ by rounding of the entries of K
  std::vector<double> x{};   // (n)
};

/// Takes one factorisation of K if it is positive definite, else a few of K + σM, σ > −λ. K: symmetric. is_left_out(x):
/// whether a mode is to be ignored, so that the lowest of the others is looked for; not found if a dozen modes are
/// ignored.
LowestMode lowest_mode(const SparseMatrix& K, const Mass& mass,
                       const std::function<bool(const std::vector<double>& x)>& is_left_out = {});

}  // namespace stillpoint
