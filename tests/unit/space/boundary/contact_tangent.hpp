// The tangent of a phase in which something touches, beside the differences of its forces.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "statics.hpp"

namespace stillpoint::test {

inline const std::vector<std::string> contact_states = {"plane-strain", "axisymmetric", "space"};

/// Some displacements, different from unknown to unknown.
inline std::vector<double> some_motion(std::size_t n, double size) {
  std::vector<double> u(n);
  for (std::size_t k = 0; k < n; ++k) u[k] = size * std::sin(static_cast<double>(3 * k + 1));
  return u;
}

/// The consistent tangent at (t, u) along du.
struct ContactTangent {
  double error = 0;       // the largest, of its product beside a central difference of R
  double difference = 0;  // the largest between its product and that of its matrix
  double scale = 0;       // the largest of the central difference
  SparseMatrix K;

  ContactTangent(const LagrangianPhase& phase, double t, const std::vector<double>& u, const std::vector<double>& du)
      : K(phase.tangents().matrix(Tangent::consistent, t, u)) {
    constexpr double h = 1e-6;
    const std::size_t n = phase.size();
    std::vector<double> to = u, from = u, product(n);
    for (std::size_t k = 0; k < n; ++k) to[k] += h * du[k], from[k] -= h * du[k];
    const std::vector<double> ahead = statics::internal_force(phase, to, t),
                              behind = statics::internal_force(phase, from, t);
    phase.tangents().apply(Tangent::consistent, t, u, du, product);
    const Eigen::VectorXd by_matrix = K * Eigen::Map<const Eigen::VectorXd>(du.data(), static_cast<Eigen::Index>(n));
    for (std::size_t k = 0; k < n; ++k) {
      const double slope = (ahead[k] - behind[k]) / (2 * h);
      error = std::max(error, std::abs(slope - product[k]));
      difference = std::max(difference, std::abs(by_matrix[static_cast<Eigen::Index>(k)] - product[k]));
      scale = std::max(scale, std::abs(slope));
    }
  }

  double asymmetry() const { return (K - SparseMatrix(K.transpose())).norm() / K.norm(); }
};

/// Whether held pieces make the body stiffer along du than what touches at (0, u).
inline bool is_stiffer_held(const LagrangianPhase& phase, const std::vector<double>& u, const std::vector<double>& du) {
  const SparseMatrix stiffest = phase.tangents().matrix(Tangent::stiffest, 0, u),
                     elastic = phase.tangents().matrix(Tangent::elastic, 0, u);
  const Eigen::Map<const Eigen::VectorXd> x(du.data(), static_cast<Eigen::Index>(du.size()));
  return x.dot(stiffest * x) > x.dot(elastic * x);
}

}  // namespace stillpoint::test
