#include "space/phase/matrix_with_means.hpp"

namespace stillpoint {

SparseMatrix matrix_with_means(const SparseMatrix& K_uu, const SparseMatrix& G, const EntriesOfMeans& entries) {
  const auto made = [](Eigen::Index rows, Eigen::Index columns, const MatrixEntries& of) {
    SparseMatrix matrix(rows, columns);
    matrix.setFromTriplets(of.begin(), of.end());
    return matrix;
  };
  const Eigen::Index n = K_uu.rows(), s = G.rows();
  const SparseMatrix K_uc = made(n, s, entries.force_of_mean), K_cu = made(s, n, entries.share_of_u);
  const SparseMatrix D = made(s, n, entries.mean_of_u), K_cc = made(s, s, entries.share_of_mean), GD = G * D;
  const SparseMatrix of_shares = K_cu + K_cc * GD, of_means = K_uc * GD, given = GD.transpose() * of_shares;
  return K_uu + of_means + given;
}

}  // namespace stillpoint
