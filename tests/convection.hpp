// An unsymmetric matrix, for tests: convection and diffusion on m × m nodes, upwind along x, and along y with as much.
#pragma once

#include <stillpoint/sparse_matrix.hpp>

#include <vector>

#include <Eigen/SparseCore>

namespace stillpoint::test {

/// (m² × m²), unsymmetric by `along_x` and `along_y`.
inline SparseMatrix convection(int m, double along_x, double along_y = 0) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < m; ++i) {
      const int k = j * m + i;
      entries.emplace_back(k, k, 4 + along_x + along_y);
      if (i > 0) entries.emplace_back(k, k - 1, -1 - along_x), entries.emplace_back(k - 1, k, -1);
      if (j > 0) entries.emplace_back(k, k - m, -1 - along_y), entries.emplace_back(k - m, k, -1);
    }
  }
  SparseMatrix A(m * m, m * m);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace stillpoint::test
