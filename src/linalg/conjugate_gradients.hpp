// Preconditioned conjugate gradients on A x = b, A symmetric positive definite.
#pragma once

#include <functional>

#include "linalg/linear_map.hpp"

namespace stillpoint {

struct IterativeResult {
  int iterations = 0;  // products with A
  bool converged = false;
  bool indefinite = false;  // stopped by a direction with pᵀAp ≤ 0, or not a number
};

/// x = A⁻¹ b from x = 0 with the preconditioner B ≈ A⁻¹, symmetric positive definite, until ‖b − A x‖ ≤ tolerance ‖b‖
/// by the recurrence of the residual. b, x: (n). Calls each(‖b − A x‖) after every iteration. [Hestenes and Stiefel
/// 1952; Saad 2003, algorithm 9.1]
IterativeResult conjugate_gradients(const LinearMap& A, const LinearMap& B, ConstVec b, Vec x, double tolerance,
                                    int max_iterations, const std::function<void(double)>& each = {});

/// The preconditioner diag(D)⁻¹; D has to outlive it.
LinearMap division_by(ConstVec D);

}  // namespace stillpoint
