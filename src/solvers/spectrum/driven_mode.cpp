#include "solvers/spectrum/driven_mode.hpp"

#include <cmath>

#include <Eigen/SparseCore>

#include "base/stop_request.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "solvers/spectrum/largest_entry.hpp"

namespace stillpoint {

DrivenMode driven_mode(const SparseMatrix& K, const Mass& mass, ConstVec Q) {
  constexpr double shift = 1e-10;
  constexpr int most_iterations = 30;
  constexpr double same = 1e-9;  // change of x from one iteration to the next, relative to x
  const double scale = largest_entry(K, mass), sigma = shift * scale;
  DrivenMode mode;
  if (!(scale >= 0) || !std::isfinite(scale) || Q.empty()) return mode;
  const auto n = static_cast<Eigen::Index>(Q.size());
  const Eigen::Map<const Eigen::VectorXd> force(Q.data(), n);
  Eigen::VectorXd x(n), Mx = force;
  mass.solve(Q, {x.data(), Q.size()});
  const double all = std::sqrt(x.dot(force));  // √(QᵀM⁻¹Q)
  if (!(all > 0) || !std::isfinite(all)) return mode;
  // Without any stiffness every motion has K x = 0.
  if (scale == 0) return {.found = true, .share = 1, .x = {x.data(), x.data() + n}};
  const SparseCholesky factor(SparseMatrix(K + sigma * mass.matrix()));
  if (!factor.positive_definite()) return mode;
  double change = 1;
  for (int iteration = 0; iteration < most_iterations && !(mode.found && change <= same); ++iteration) {
    heed_stop_request();
    const Eigen::VectorXd before = x;
    factor.solve({Mx.data(), Q.size()}, {x.data(), Q.size()});
    mass.apply({x.data(), Q.size()}, {Mx.data(), Q.size()});
    const double length = std::sqrt(x.dot(Mx));
    x /= length;
    Mx /= length;
    change = (x - before).norm() / x.norm();
    mode.found = x.dot(K * x) <= rounding_of_eigenvalues * scale;
  }
  mode.share = std::abs(x.dot(force)) / all;
  mode.x.assign(x.data(), x.data() + n);
  return mode;
}

}  // namespace stillpoint
