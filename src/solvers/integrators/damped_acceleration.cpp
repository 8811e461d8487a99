#include "solvers/integrators/damped_acceleration.hpp"

#include <cmath>
#include <stdexcept>

#include <Eigen/SparseCore>

#include "solvers/spectrum/two_by_two.hpp"

namespace stillpoint {
namespace {

/// The place between v⁻ (0) and v⁺ (1) at which C is applied.
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
    implicitness(treatment_);  // throws if the treatment has none
    if (C_.mass != 0) Mv_.resize(mass_.size());
  }
}

// The work that couples degrees of freedom: afterwards each has its own mass, or its acceleration.
void DampedAcceleration::couple(double h, ConstVec v, Vec Q_to_a) {
  if (is_coupled()) {
    solve_coupled(h, v, Q_to_a);
  } else if (mass_.is_lumped()) {
    mass_.decouple(Q_to_a);
    make_factors(h);
  } else {
    mass_.solve(Q_to_a, Q_to_a);
  }
  h_ = h;
}

void DampedAcceleration::make_factors(double h) {
  if (C_.identity == 0 || h == h_) return;
  const ConstVec m = mass_.diagonal();
  for (std::size_t i = 0; i < m.size(); ++i) {
    factor_[i] = damping_factor(treatment_, h * (C_.mass + C_.identity / m[i]));
  }
}

// Computes a = g(h r) (M⁻¹ Q − r v) for a piece of the degrees of freedom.
void DampedAcceleration::of_piece(double h, std::size_t begin, ConstVec v, Vec a) const {
  if (is_coupled()) return;
  const double* m = mass_.diagonal().data() + begin;
  if (mass_.is_lumped()) for_each_index(a.size(), [=](std::size_t i) { a[i] /= m[i]; });
  if (C_.identity != 0) {
    for_each_index(a.size(), [=, C = C_, g = factor_.data() + begin](std::size_t i) {
      a[i] = g[i] * (a[i] - (C.mass + C.identity / m[i]) * v[i]);
    });
  } else if (C_.mass != 0) {
    const double r = C_.mass, g = damping_factor(treatment_, h * r);
    for_each_index(a.size(), [=](std::size_t i) { a[i] = g * (a[i] - r * v[i]); });
  }
}

// Solves (M + θ h C) a = Q − C v,  M + θ h C = (1 + θ h c_m) M + θ h c_i I.
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
