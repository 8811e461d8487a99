#include "statics.hpp"

#include <limits>

#include <Eigen/SparseCholesky>

namespace statics {

std::vector<double> solution(const LagrangianPhase& phase) {
  const auto n = static_cast<Eigen::Index>(phase.size());
  std::vector<double> u(phase.size(), 0.0);
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 40; ++iteration) {
    std::vector<double> Q = out_of_balance(phase, u);
    const Eigen::SimplicialLDLT<stillpoint::SparseMatrix> factor(phase.tangents().matrix(Tangent::consistent, 0, u));
    const Eigen::VectorXd step = factor.solve(Eigen::Map<Eigen::VectorXd>(Q.data(), n));
    const Eigen::VectorXd old = Eigen::Map<Eigen::VectorXd>(u.data(), n);
    double share = 1;
    std::vector<double> R(phase.size());
    do {
      Eigen::Map<Eigen::VectorXd>(u.data(), n) = old + share * step;
      share /= 2;
    } while (!phase.internal_force(0, u, R, *phase.make_trial()) && share > 1e-3);
    const double size = step.norm() / Eigen::Map<Eigen::VectorXd>(u.data(), n).norm();
    if (size < 1e-14 || (size < 1e-11 && size >= before)) break;
    before = size;
  }
  return u;
}

}  // namespace statics
