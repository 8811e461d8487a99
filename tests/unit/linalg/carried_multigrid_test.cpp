#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "largest.hpp"
#include "linalg/multigrid.hpp"

using namespace stillpoint;

namespace {

/// A symmetric positive definite matrix in the place of a cycle.
class Full final : public Multigrid {
 public:
  explicit Full(Eigen::MatrixXd B) : B_(std::move(B)) {}
  void apply(ConstVec b, Vec x) const override {
    const Eigen::VectorXd product = B_ * Eigen::Map<const Eigen::VectorXd>(b.data(), B_.rows());
    Eigen::Map<Eigen::VectorXd>(x.data(), B_.rows()) = product;
  }
  int levels() const override { return 1; }
  std::size_t bytes() const override { return 0; }

 private:
  Eigen::MatrixXd B_;
};

/// B_ij = 1/(1 + |i − j|), n = 5: all entries tell which they are.
Eigen::MatrixXd full() {
  Eigen::MatrixXd B(5, 5);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) B(i, j) = 1.0 / (1 + std::abs(i - j)) + (i == j ? i : 0);
  return B;
}

/// Nodes at (0, 0) on a roller, (1, 0), (0, 1).
const NodalLayout before = {2, {0, 1, 1, 2, 2}, {1, 0, 1, 0, 1}, {0, 0, 1, 0, 0, 1}};
/// (0, 0) is gone, (2, 0) is new.
const NodalLayout after = {2, {0, 0, 1, 1, 2, 2}, {0, 1, 0, 1, 0, 1}, {1, 0, 2, 0, 0, 1}};

Eigen::MatrixXd matrix_of(const Multigrid& cycle, std::size_t n) {
  Eigen::MatrixXd B(n, n);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> x(n, 0.0);
    x[k] = 1;
    cycle.apply(x, x);
    B.col(static_cast<Eigen::Index>(k)) = Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(n));
  }
  return B;
}

SparseMatrix diagonal_stiffness(const std::vector<double>& values) {
  const auto n = static_cast<Eigen::Index>(values.size());
  SparseMatrix K(n, n);
  for (Eigen::Index k = 0; k < n; ++k) K.insert(k, k) = values[static_cast<std::size_t>(k)];
  K.makeCompressed();
  return K;
}

}  // namespace

TEST_CASE("a cycle carried to the same unknowns is the cycle, to the bit") {
  const auto B = std::make_shared<Full>(full());
  const auto carried = carry(B, before, before, diagonal_stiffness({1, 1, 1, 1, 1}));
  CHECK(matrix_of(*carried, 5) == full());
}

TEST_CASE("a carried cycle has what old unknowns answer to each other, and new ones divide by their stiffness") {
  const auto carried = carry(std::make_shared<Full>(full()), before, after, diagonal_stiffness({7, 7, 4, 8, 7, 7}));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(6, 6);
  const std::vector<int> old = {1, 2, -1, -1, 3, 4};  // of each new unknown
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j)
      if (old[static_cast<std::size_t>(i)] >= 0 && old[static_cast<std::size_t>(j)] >= 0)
        expected(i, j) = full()(old[static_cast<std::size_t>(i)], old[static_cast<std::size_t>(j)]);
  }
  expected(2, 2) = 1.0 / 4;
  expected(3, 3) = 1.0 / 8;
  CHECK((matrix_of(*carried, 6) - expected).norm() <= 1e-15);
  CHECK(matrix_of(*carried, 6).llt().info() == Eigen::Success);
}
