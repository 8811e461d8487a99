// The largest eigenvalue of A x = λ B x by power iteration, for uses in which a lower bound or a rough value is enough:
//   ω_max²: A = K, B = M      1/λ_min(D⁻¹M): A = D, B = M      λ_max(M): A = M, B = I
#pragma once

#include <vector>

#include "linalg/linear_map.hpp"

namespace stillpoint {

struct PowerIterationResult {
  double eigenvalue = 0;      // ρ = xᵀAx/xᵀBx, a lower bound if A is positive semidefinite
  double relative_error = 0;  // estimate of (λ − ρ)/ρ
  int iterations = 0;         // applications of B⁻¹A
  bool converged = false;     // relative_error ≤ tolerance
  std::vector<double> x{};    // xᵀBx = 1, (n)
};

/// Iterates x ← B⁻¹A x from start_vector(n), until the error estimate is at most the tolerance three times running. A,
/// B symmetric, B positive definite. Stops with a NaN eigenvalue if a value is not finite, and without convergence if
/// rounding outweighs what is left to gain.
PowerIterationResult power_iteration(std::size_t n, const LinearMap& apply_A, const LinearMap& solve_B,
                                     double tolerance, int max_iterations);

/// Pseudo-random numbers in [−1, 1], (n), the same on every machine and in every run.
std::vector<double> start_vector(std::size_t n);

}  // namespace stillpoint
