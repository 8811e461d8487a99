// Static solutions of a phase without any relaxation, and what its points and nodes show.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <limits>
#include <vector>

#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>

#include "space/phase/lagrangian_phase.hpp"

namespace statics {

using stillpoint::ConstVec;
using stillpoint::LagrangianPhase;
using stillpoint::Tangent;

inline std::vector<double> internal_force(const LagrangianPhase& phase, ConstVec u, double t = 0) {
  std::vector<double> R(phase.size());
  REQUIRE(phase.internal_force(t, u, R, *phase.make_trial()));
  return R;
}

/// What points remember from now on: the state at (t, u).
inline void commit(LagrangianPhase& phase, ConstVec u, double t = 0) {
  std::vector<double> R(phase.size());
  const auto trial = phase.make_trial();
  REQUIRE(phase.internal_force(t, u, R, *trial));
  phase.commit(*trial);
}

/// F(t) − R(u), with loads that follow u.
inline std::vector<double> out_of_balance(const LagrangianPhase& phase, ConstVec u, double t = 0) {
  std::vector<double> Q(phase.size());
  phase.external_force(t, u, Q);
  const std::vector<double> R = internal_force(phase, u, t);
  for (std::size_t k = 0; k < Q.size(); ++k) Q[k] -= R[k];
  return Q;
}

/// Newton's method on F − R(u) = 0 with Eigen's own factor, so that nothing of the relaxation takes part. A step that
/// turns a point inside out is halved.
inline std::vector<double> solution(const LagrangianPhase& phase) {
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

/// Displacements (P × dim) and Cauchy stresses (P × 4) at the points.
inline std::vector<double> point_displacement(const LagrangianPhase& phase, ConstVec u, double t = 0) {
  std::vector<double> out(static_cast<std::size_t>(phase.dim()) * phase.points());
  phase.point_displacement(t, u, out);
  return out;
}
inline std::vector<double> point_stress(const LagrangianPhase& phase, ConstVec u, double t = 0) {
  std::vector<double> out(static_cast<std::size_t>(phase.info().stress_components) * phase.points());
  phase.point_stress(t, u, out);
  return out;
}

}  // namespace statics
