// The out-of-balance force of a static problem, and the scale by which it is small.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace stillpoint {

inline double dot(ConstVec x, ConstVec y) { return std::inner_product(x.begin(), x.end(), y.begin(), 0.0); }
inline double norm(ConstVec x) { return std::sqrt(dot(x, x)); }

/// y −= s A x
inline void subtract_product(double s, const SparseMatrix& A, ConstVec x, Vec y) {
  if (A.nonZeros() == 0) return;
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::Map<Eigen::VectorXd>(y.data(), n) -= s * (A * Eigen::Map<const Eigen::VectorXd>(x.data(), n));
}

/// Q_s(u) = (1 − s) R₀ + s F(t, u) − R(t, u), s the load factor, R₀ the internal force at the start.
class OutOfBalance {
 public:
  OutOfBalance(const SemiDiscrete& system, double t)
      : Q(system.size()), system_(system), t_(t), dead_(system.size()), F_(system.size()), R_(system.size()) {
    if (system.has_contact())
      throw std::invalid_argument("a static solution with contact is not written: take relaxation, or supports");
    system.external_force(t, dead_);
  }

  /// R₀ = R(u). False where u is inadmissible.
  bool start(ConstVec u) {
    if (!evaluate(1, u)) return false;
    R0_ = R_;
    return true;
  }
  /// Q and residual() at u. False where u is inadmissible.
  bool evaluate(double s, ConstVec u) {
    ++evaluations;
    if (!system_.internal_force(t_, u, R_)) return false;
    F_ = dead_;
    system_.add_following_force(t_, u, F_);
    for (std::size_t i = 0; i < Q.size(); ++i) Q[i] = s * F_[i] - R_[i] + (s < 1 ? (1 - s) * R0_[i] : 0);
    const double loads = norm(F_);
    force_scale_ = std::max({force_scale_, loads, loads > 0 ? 0 : system_.reaction_norm()});
    internal_scale_ = std::max(internal_scale_, norm(R_));
    scale_ = loads > 0 ? loads : force_scale_ > 0 ? force_scale_ : internal_scale_;
    return true;
  }
  /// ‖Q‖/‖F‖; where F = 0 of the largest reactions or, without any, of the largest ‖R‖. As RelaxationSystem has it.
  double residual() const {
    const double unbalanced = norm(Q);
    return unbalanced == 0 ? 0 : unbalanced / scale_;
  }

  std::vector<double> Q;  // of the last evaluation, (n) [N]
  long evaluations = 0;

 private:
  const SemiDiscrete& system_;
  double t_;
  std::vector<double> dead_, F_, R_, R0_;
  double force_scale_ = 0, internal_scale_ = 0, scale_ = 0;
};

}  // namespace stillpoint
