#include "solvers/spectrum/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillpoint {
namespace {

double largest_diagonal_ratio(const SparseMatrix& K, const Mass& mass) {
  const Eigen::VectorXd diagonal = K.diagonal();
  double largest = 0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    largest = std::max(largest, std::abs(diagonal[static_cast<Eigen::Index>(i)]) / mass.diagonal()[i]);
  }
  return largest;
}

}  // namespace

FactorisedStiffness::FactorisedStiffness(const Mass& mass, const SparseMatrix& K)
    : mass_(mass), K_(K), factor_(K), scale_(largest_diagonal_ratio(K_, mass_)) {}

std::string FactorisedStiffness::refusal(double omega_squared) const {
  if (mass_.size() == 0) return "no free degrees of freedom";
  const std::string singular = "K is singular: the body is not held, or has too few material points for its basis";
  if (usable()) {
    // The factor is exact for a K that is off by a few roundings of its entries, which move ω² by a few eps ω_max²:
    // an ω₁² of that size is a zero.
    return omega_squared > 64 * std::numeric_limits<double>::epsilon() * scale_ ? "" : singular;
  }
  for (Eigen::Index k = 0; k < K_.nonZeros(); ++k) {
    if (!std::isfinite(K_.valuePtr()[k])) return "K is not finite";
  }
  // An eigenvalue 0 that rounding pushed below zero is lifted by a shift of 1e-10 ω_max²; a negative ω² is not.
  const bool semidefinite =
      scale_ == 0 || SparseCholesky(SparseMatrix(K_ + 1e-10 * scale_ * mass_.matrix())).positive_definite();
  return semidefinite ? singular : "K is indefinite: R softens, the state is unstable";
}

}  // namespace stillpoint
