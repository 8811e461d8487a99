// An estimate of the size of the eigenvalues of K x = λ M x that computes none of them.
#pragma once

#include <stillpoint/mass.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SparseCore>

namespace stillpoint {

/// The effect of rounding in the entries of K on λ, relative to largest_entry().
constexpr double rounding_of_eigenvalues = 64 * std::numeric_limits<double>::epsilon();

/// max |K_ij|/√(M_ii M_jj), of the size of the largest |λ|; NaN if an entry is NaN. All entries are searched because an
/// indefinite K may have a zero diagonal.
inline double largest_entry(const SparseMatrix& K, const Mass& mass) {
  double largest = 0;
  for (Eigen::Index j = 0; j < K.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(K, j); entry; ++entry) {
      const auto row = static_cast<std::size_t>(entry.row()), column = static_cast<std::size_t>(j);
      const double size = std::abs(entry.value()) / std::sqrt(mass.diagonal()[row] * mass.diagonal()[column]);
      if (std::isnan(size)) return size;
      largest = std::max(largest, size);
    }
  }
  return largest;
}

}  // namespace stillpoint
