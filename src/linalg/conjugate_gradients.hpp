// Preconditioned conjugate gradients on A x = b, A symmetric positive definite.
#pragma once

#include <functional>

#include "linalg/linear_map.hpp"

namespace stillpoint {

struct IterativeResult {
  int iterations = 0;  // products with A
  bool converged = false;
  bool indefinite = false;  // a direction with pᵀAp ≤ 0, or not a number, ended it
};

/// x = A⁻¹ b from x = 0 with the preconditioner B ≈ A⁻¹, symmetric positive definite, until ‖b − A x‖ ≤ tolerance ‖b‖
/// by its recurrence. b, x: (n). each(‖b − A x‖) after every iteration. [Hestenes and Stiefel 1952; Saad 2003,
/// algorithm 9.1]
IterativeResult conjugate_gradients(const LinearMap& A, const LinearMap& B, ConstVec b, Vec x, double tolerance,
                                    int max_iterations, const std::function<void(double)>& each = {});

/// The preconditioner diag(D)⁻¹; D outlives it.
LinearMap division_by(ConstVec D);

}  // namespace stillpoint
