// The stiffness of a body whose points share their change of volume over splines.
#pragma once

#include <stillpoint/sparse_matrix.hpp>

#include "space/grid/matrix_entries.hpp"

namespace stillpoint {

/// The entries of matrices, summed over the cells; n unknowns u, s coefficients c of means.
struct EntriesOfMeans {
  const MatrixEntries& force_of_mean;  // K_uc, (n × s)
  const MatrixEntries& share_of_u;     // K_cu, (s × n)
  const MatrixEntries& mean_of_u;      // D, (s × n)
  const MatrixEntries& share_of_mean;  // K_cc, (s × s)
};

/// The stiffness matrix with c = G D u the coefficients of the means, D_A = Σ_p V_p N_pA ∂J_p/∂u, and R = R(u, c) + Dᵀ
/// G Σ_p N_p y_p:
///
///   K = K_uu + K_uc G D + (G D)ᵀ (K_cu + K_cc G D)
///
/// where K_uc = ∂R/∂c, K_cu and K_cc are derivatives of Σ_p N_p y_p, and K_uu is that of R(u, c) and of D at its
/// shares.
SparseMatrix matrix_with_means(const SparseMatrix& K_uu, const SparseMatrix& G, const EntriesOfMeans& entries);

}  // namespace stillpoint
