// A small symmetric matrix without its negative eigenvalues.
#pragma once

#include <array>
#include <cstddef>

namespace stillpoint {

/// Replaces A by Σ max(λ, 0) v vᵀ over the eigenpairs of A's symmetric part; A: (N × N) by rows, finite. N is the
/// number of components of a displacement gradient: 1, 4, 5 or 9.
template <std::size_t N2>
void take_positive_part(std::array<double, N2>& A);

}  // namespace stillpoint
