// The Rayleigh quotients of a motion, which estimate the frequency that dominates it, from the last step alone.
//
//   global     ω² = vᵀΔR/(h vᵀMv),   ΔR = R(u_{n+1}) − R(u_n) = K h v: the quotient of v, never below ω₁²
//   diagonal   ω² = uᵀSu/uᵀMu,   S_ii = ΔR_i/(h v_i), the stiffness that each degree of freedom feels by itself
//              [Underwood, "Dynamic relaxation", in Belytschko and Hughes (eds.), Computational Methods for Transient
//              Analysis, 1983, eq. 5.24]
//
// Both are 0 if the motion has no stiffness, or a negative one.
#pragma once

#include <stillpoint/vector.hpp>

#include <cmath>

#include "base/parallel_loop.hpp"

namespace stillpoint {

/// The global quotient [1/s²]. v, Q_before, Q: (n), ΔR = Q_before − Q under the same loads; vMv = vᵀMv; work: (n),
/// becomes ΔR.
inline double global_quotient(const Vector& v, const Vector& Q_before, const Vector& Q, double h, double vMv,
                              Vector& work) {
  if (!(vMv > 0)) return 0;
  const Vec dR = work.span();
  for_each_index(dR.size(),
                 [dR, before = Q_before.span(), now = Q.span()](std::size_t i) { dR[i] = before[i] - now[i]; });
  const double quotient = dot(v, work) / (h * vMv);
  return quotient > 0 ? quotient : 0;  // also if it is not a number
}

/// The diagonal quotient [1/s²]. u, v, Q_before, Q: (n); uMu = uᵀMu; work: (n), becomes Su.
inline double diagonal_quotient(const Vector& u, const Vector& v, const Vector& Q_before, const Vector& Q, double h,
                                double uMu, Vector& work) {
  if (!(uMu > 0)) return 0;
  const Vec Su = work.span();
  for_each_index(Su.size(), [=, u = u.span(), v = v.span(), before = Q_before.span(), now = Q.span()](std::size_t i) {
    const double S = (before[i] - now[i]) / (h * v[i]);
    Su[i] = std::isfinite(S) ? S * u[i] : 0.0;
  });
  const double quotient = dot(u, work) / uMu;
  return quotient > 0 ? quotient : 0;
}

}  // namespace stillpoint
