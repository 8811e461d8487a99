// GMRES with restarts on A x = b, A regular, by SUNDIALS [Saad and Schultz 1986].
#pragma once

#include "linalg/conjugate_gradients.hpp"
#include "linalg/linear_map.hpp"

namespace stillpoint {

/// x = A⁻¹ b from x = 0 with the preconditioner B ≈ A⁻¹ from the right, until ‖b − A x‖ ≤ tolerance ‖b‖. b, x: (n).
/// Restarts every 60 products, and keeps as many vectors. Throws std::runtime_error if SUNDIALS cannot be set up.
IterativeResult gmres(const LinearMap& A, const LinearMap& B, ConstVec b, Vec x, double tolerance, int max_iterations);

}  // namespace stillpoint
