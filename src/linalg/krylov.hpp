// Preconditioned Krylov methods on A x = b, of which only products with A are known.
#pragma once

#include <functional>

#include "linalg/linear_map.hpp"

namespace stillpoint {

struct IterativeResult {
  int iterations = 0;  // products with A
  bool converged = false;
  bool indefinite = false;  // stopped by a direction with pᵀAp ≤ 0, or not a number
};

/// Conjugate gradients: x = A⁻¹ b from x = 0, A and the preconditioner B ≈ A⁻¹ symmetric positive definite, until
/// ‖b − A x‖ ≤ tolerance ‖b‖ by the recurrence of the residual. b, x: (n). Calls each(‖b − A x‖) after every iteration.
/// [Hestenes and Stiefel 1952; Saad 2003, algorithm 9.1]
IterativeResult conjugate_gradients(const LinearMap& A, const LinearMap& B, ConstVec b, Vec x, double tolerance,
                                    int max_iterations, const std::function<void(double)>& each = {});

/// The preconditioner diag(D)⁻¹; D has to outlive it.
LinearMap division_by(ConstVec D);

/// GMRES by SUNDIALS: x = A⁻¹ b from x = 0, A regular, with the preconditioner B ≈ A⁻¹ from the right, until
/// ‖b − A x‖ ≤ tolerance ‖b‖. b, x: (n). Restarts every 60 products, and keeps as many vectors. Throws
/// std::runtime_error if SUNDIALS cannot be set up. [Saad and Schultz 1986]
IterativeResult gmres(const LinearMap& A, const LinearMap& B, ConstVec b, Vec x, double tolerance, int max_iterations);

}  // namespace stillpoint
