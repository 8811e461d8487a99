// Consistent volumes: weights of the material points of one cell that integrate polynomials exactly.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace stillpoint {

/// Weights of n points in the cube [−1, 1]^Dim, as shares of its volume.
struct MomentFit {
  Eigen::VectorXd weights;       // (n), ≥ 0, sum 1
  int degree = 0;                // every product of powers up to this one in each coordinate is integrated exactly
  bool limited_by_sign = false;  // a higher degree has weights, but only with a negative one
};

/// The weights with Σ_p w_p q(ξ_p) = mean of q over the cube, for all polynomials q up to the highest degree that the
/// points can integrate with w ≥ 0; if they are not unique, the w nearest to 1/n. xi: (Dim × n) positions of the points
/// in the cube, n ≥ 1. Degrees are tried in whole groups of equal (largest, total) power, so that no coordinate is
/// preferred. Source of the constrained fit: Lawson and Hanson 1974, problem LDP (least distance programming, chapter
/// 23).
MomentFit fit_moments(const Eigen::MatrixXd& xi);

/// The weights 1/n, with the degree that they happen to integrate.
MomentFit equal_weights(const Eigen::MatrixXd& xi);

/// The weights nearest to given ones that satisfy A w = b and w ≥ 0, empty if there are none.
struct ConstrainedFit {
  std::optional<Eigen::VectorXd> weights;
  bool consistent = false;  // A w = b has solutions of any sign
};

/// Solves min ‖w − target‖ with A w = b, w ≥ 0. Rows of A of order one.
ConstrainedFit nearest_nonnegative(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& target);

/// The products P_k(ξ_1) P_{degree−k}(ξ_2), k = 0 … degree: with those of lower degrees, a basis of the polynomials of
/// this total degree. xi: (2 × n); returns (degree + 1 × n).
Eigen::MatrixXd legendre_products(const Eigen::MatrixXd& xi, int degree);

}  // namespace stillpoint
