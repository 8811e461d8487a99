#include "space/points/moment_fit.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/QR>

#include "base/special_functions.hpp"
#include "space/points/nonnegative_least_squares.hpp"

namespace stillpoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rounding_of_moments = 1e-11;  // for moments of order one
constexpr int highest_degree = 9;              // more than any basis here can use

// The powers (k_1, ..., k_Dim) by (largest, total): the groups in which degrees are tried.
std::map<std::pair<int, int>, std::vector<std::vector<int>>> power_groups(int dim, int degree) {
  std::map<std::pair<int, int>, std::vector<std::vector<int>>> groups;
  std::vector<int> k(static_cast<std::size_t>(dim), 0);
  while (true) {
    int largest = 0, total = 0;
    for (const int power : k) largest = std::max(largest, power), total += power;
    groups[{largest, total}].push_back(k);
    std::size_t d = 0;
    while (d < k.size() && ++k[d] > degree) k[d++] = 0;
    if (d == k.size()) return groups;
  }
}

// The values of the Legendre polynomials of each coordinate at the points, and their products: well conditioned, and
// all their means but the first vanish.
class Legendre {
 public:
  explicit Legendre(const MatrixXd& xi) : values_(xi.rows() * stride, xi.cols()) {
    for (Index d = 0; d < xi.rows(); ++d) {
      for (int k = 0; k < stride; ++k) {
        for (Index p = 0; p < xi.cols(); ++p) {
          values_(d * stride + k, p) = legendre(k, std::clamp(xi(d, p), -1.0, 1.0));
        }
      }
    }
  }
  // The products, one row for each product of powers, one column for each point.
  MatrixXd products(const std::vector<std::vector<int>>& powers) const {
    MatrixXd rows = MatrixXd::Ones(static_cast<Index>(powers.size()), values_.cols());
    for (std::size_t j = 0; j < powers.size(); ++j) {
      for (std::size_t d = 0; d < powers[j].size(); ++d) {
        rows.row(static_cast<Index>(j)).array() *= values_.row(static_cast<Index>(d) * stride + powers[j][d]).array();
      }
    }
    return rows;
  }

 private:
  static constexpr int stride = highest_degree + 1;
  MatrixXd values_;
};

}  // namespace

ConstrainedFit nearest_nonnegative(const MatrixXd& A, const VectorXd& b, const VectorXd& target) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> decomposition(A);
  const VectorXd w = target + decomposition.solve(b - A * target);
  if ((A * w - b).lpNorm<Eigen::Infinity>() > rounding_of_moments) return {};
  if (w.minCoeff() >= -rounding_of_moments) return {w.cwiseMax(0), true};

  // Finds the smallest z with w + Z z ≥ 0, Z an orthonormal basis of the null space of A: problem LDP, solved through
  // NNLS with E = [Zᵀ; −wᵀ], f = e_last; a vanishing residual means that no such z exists.
  const Index n = A.cols(), rank = decomposition.rank();
  if (rank == n) return {std::nullopt, true};
  const MatrixXd null_space =
      Eigen::ColPivHouseholderQR<MatrixXd>(A.transpose()).householderQ() * MatrixXd::Identity(n, n).rightCols(n - rank);
  MatrixXd E(n - rank + 1, n);
  E << null_space.transpose(), -w.transpose();
  const VectorXd f = VectorXd::Unit(n - rank + 1, n - rank);
  const VectorXd residual = E * solve_nnls(E, f) - f;
  if (residual.norm() < 1e-9) return {std::nullopt, true};
  const VectorXd z = -residual.head(n - rank) / residual(n - rank);
  return {(w + null_space * z).cwiseMax(0), true};
}

MatrixXd legendre_products(const MatrixXd& xi, int degree) {
  std::vector<std::vector<int>> powers;
  for (int k = 0; k <= degree; ++k) powers.push_back({k, degree - k});
  return Legendre(xi).products(powers);
}

MomentFit fit_moments(const MatrixXd& xi) {
  assert(xi.rows() >= 1 && xi.cols() >= 1);
  const Index n = xi.cols();
  const Legendre legendre(xi);
  const VectorXd equal = VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  MomentFit fit{equal, 0, false};
  MatrixXd A = MatrixXd::Ones(1, n);  // constraint: the weights sum to 1
  int failed_at = highest_degree + 1;
  for (const auto& [degree, powers] : power_groups(static_cast<int>(xi.rows()), highest_degree)) {
    const int largest = degree.first;
    if (largest == 0) continue;
    if (largest > failed_at) break;
    MatrixXd trial(A.rows() + static_cast<Index>(powers.size()), n);
    trial << A, legendre.products(powers);
    const auto [weights, consistent] = nearest_nonnegative(trial, VectorXd::Unit(trial.rows(), 0), equal);
    if (weights) {
      A = trial;
      fit.weights = *weights;
    } else {
      failed_at = std::min(failed_at, largest);
      fit.limited_by_sign |= consistent;
    }
  }
  fit.degree = failed_at - 1;
  return fit;
}

MomentFit equal_weights(const MatrixXd& xi) {
  const Index n = xi.cols();
  const Legendre legendre(xi);
  MomentFit fit{VectorXd::Constant(n, 1.0 / static_cast<double>(n)), highest_degree, false};
  for (const auto& [degree, powers] : power_groups(static_cast<int>(xi.rows()), highest_degree)) {
    const int largest = degree.first;
    if (largest == 0) continue;
    if ((legendre.products(powers) * fit.weights).lpNorm<Eigen::Infinity>() > rounding_of_moments) {
      fit.degree = largest - 1;
      break;
    }
  }
  return fit;
}

}  // namespace stillpoint
