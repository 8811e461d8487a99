#include "solvers/integrators/damped_acceleration.hpp"

#include <cmath>
#include <stdexcept>

#include <Eigen/SparseCore>

#include "base/parallel_loop.hpp"
#include "solvers/spectrum/two_by_two.hpp"

namespace stillpoint {
namespace {

/// Where between v⁻ (0) and v⁺ (1) C is applied.
double implicitness(DampingTreatment treatment) {
  switch (treatment) {
    case DampingTreatment::lagged:
      return 0;
    case DampingTreatment::averaged:
      return 0.5;
    case DampingTreatment::implicit:
      return 1;
    default:
      throw std::invalid_argument("exact damping needs C and M to be diagonal together");
  }
}

}  // namespace

double damping_factor(DampingTreatment treatment, double z) {
  if (treatment == DampingTreatment::exact) return z == 0 ? 1 : -std::expm1(-z) / z;
  return 1 / (1 + implicitness(treatment) * z);
}

// With Q = −ω² u, M = 1, C = r, z = h r:  v⁺ = (1 − z g) v⁻ − h ω² g u,  u⁺ = u + h v⁺,
// a map of determinant 1 − z g and trace 1 + (1 − z g) − (h ω)² g.
AmplificationRadius kick_drift_amplification(DampingTreatment treatment) {
  return [treatment](double h, double omega, double rate) {
    const double z = h * rate, g = damping_factor(treatment, z);
    const double determinant = treatment == DampingTreatment::exact ? std::exp(-z) : 1 - z * g;
    return spectral_radius({.trace = 1 + determinant - h * omega * (h * omega) * g, .determinant = determinant});
  };
}

DampedAcceleration::DampedAcceleration(DampingTreatment treatment, const LinearDamping& C, const Mass& mass)
    : treatment_(treatment), C_(C), mass_(mass) {
  if (C_.identity == 0) return;
  if (mass_.is_diagonal()) {
    factor_.resize(mass_.size());
  } else {
    implicitness(treatment_);  // throws if there is none
    if (C_.mass != 0) Mv_.resize(mass_.size());
  }
}

void DampedAcceleration::operator()(double h, ConstVec v, Vec Q_to_a) {
  if (C_.identity == 0 || mass_.is_diagonal()) {
    solve_diagonal(h, v, Q_to_a);
  } else {
    solve_coupled(h, v, Q_to_a);
  }
  h_ = h;
}

// a = g(h r) (M⁻¹ Q − r v)
void DampedAcceleration::solve_diagonal(double h, ConstVec v, Vec a) {
  mass_.solve(a, a);
  if (C_.identity == 0) {
    if (C_.mass == 0) return;
    const double r = C_.mass, g = damping_factor(treatment_, h * r);
    for_each_index(a.size(), [=](std::size_t i) { a[i] = g * (a[i] - r * v[i]); });
    return;
  }
  const ConstVec m = mass_.diagonal();
  const auto rate = [=, C = C_](std::size_t i) { return C.mass + C.identity / m[i]; };
  if (h != h_) {
    for (std::size_t i = 0; i < a.size(); ++i) factor_[i] = damping_factor(treatment_, h * rate(i));
  }
  const double* g = factor_.data();
  for_each_index(a.size(), [=](std::size_t i) { a[i] = g[i] * (a[i] - rate(i) * v[i]); });
}

// (M + θ h C) a = Q − C v,  M + θ h C = (1 + θ h c_m) M + θ h c_i I
void DampedAcceleration::solve_coupled(double h, ConstVec v, Vec a) {
  if (C_.mass != 0) {
    mass_.apply(v, Mv_);
    for_each_index(a.size(), [=, c = C_.mass, Mv = Mv_.data()](std::size_t i) { a[i] -= c * Mv[i]; });
  }
  for_each_index(a.size(), [=, c = C_.identity](std::size_t i) { a[i] -= c * v[i]; });

  const double theta_h = implicitness(treatment_) * h;
  if (theta_h == 0) {
    mass_.solve(a, a);
    return;
  }
  if (h != h_) {
    SparseMatrix A = (1 + theta_h * C_.mass) * mass_.matrix();
    A.diagonal().array() += theta_h * C_.identity;
    matrix_.emplace(A);
    if (!matrix_->positive_definite()) throw std::runtime_error("M + θ h C is not positive definite");
  }
  matrix_->solve(a, a);
}

}  // namespace stillpoint
