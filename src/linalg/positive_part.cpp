#include "linalg/positive_part.hpp"

#include <Eigen/Eigenvalues>

namespace stillpoint {

template <std::size_t N2>
void take_positive_part(std::array<double, N2>& A) {
  constexpr int n = [] {
    int root = 0;
    while (root * root < static_cast<int>(N2)) ++root;
    return root;
  }();
  static_assert(static_cast<std::size_t>(n) * n == N2, "a square matrix");
  using Matrix = Eigen::Matrix<double, n, n>;
  Eigen::Map<Matrix> of_A(A.data());
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(0.5 * (of_A + of_A.transpose()));
  of_A = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
}

template void take_positive_part(std::array<double, 1>& A);
template void take_positive_part(std::array<double, 16>& A);
template void take_positive_part(std::array<double, 25>& A);
template void take_positive_part(std::array<double, 81>& A);

}  // namespace stillpoint
