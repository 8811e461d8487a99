// Static solutions of a phase without any relaxation, and what its points and nodes show.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <vector>

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
std::vector<double> solution(const LagrangianPhase& phase);

/// Displacements (P × dim) and Cauchy stresses (P × 4) at the points.
inline std::vector<double> point_displacement(const LagrangianPhase& phase, ConstVec u, double t = 0) {
  std::vector<double> out(static_cast<std::size_t>(phase.dim()) * phase.points());
  phase.fields().point_displacement(t, u, out);
  return out;
}
inline std::vector<double> point_stress(const LagrangianPhase& phase, ConstVec u, double t = 0) {
  std::vector<double> out(static_cast<std::size_t>(phase.info().stress_components) * phase.points());
  phase.fields().point_stress(t, u, out);
  return out;
}

}  // namespace statics
