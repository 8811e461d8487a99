// The Rayleigh quotients of a motion, which see the frequency that dominates it; from the last step alone.
//
//   global     ω² = vᵀΔR/(h vᵀMv),   ΔR = R(u_{n+1}) − R(u_n) = K h v: the quotient of v, never below ω₁²
//   diagonal   ω² = uᵀSu/uᵀMu,   S_ii = ΔR_i/(h v_i), the stiffness that each degree of freedom feels by itself
//              [Underwood, "Dynamic relaxation", in Belytschko and Hughes (eds.), Computational Methods for Transient
//              Analysis, 1983, eq. 5.24]
//
// 0 if the motion has no stiffness, or a negative one.
#pragma once

#include <stillpoint/types.hpp>

#include <cmath>

#include "base/parallel_loop.hpp"

namespace stillpoint {

/// v, Q_before, Q: (n), ΔR = Q_before − Q; vMv = vᵀMv.
inline double global_quotient(ConstVec v, ConstVec Q_before, ConstVec Q, double h, double vMv) {
  if (!(vMv > 0)) return 0;
  const double vdR = sum_over(v.size(), [=](std::size_t i) { return v[i] * (Q_before[i] - Q[i]); });
  const double quotient = vdR / (h * vMv);
  return quotient > 0 ? quotient : 0;  // also if it is not a number
}

/// u, v, Q_before, Q: (n); uMu = uᵀMu.
inline double diagonal_quotient(ConstVec u, ConstVec v, ConstVec Q_before, ConstVec Q, double h, double uMu) {
  if (!(uMu > 0)) return 0;
  const double uSu = sum_over(u.size(), [=](std::size_t i) {
    const double S = (Q_before[i] - Q[i]) / (h * v[i]);
    return std::isfinite(S) ? u[i] * S * u[i] : 0.0;
  });
  const double quotient = uSu / uMu;
  return quotient > 0 ? quotient : 0;
}

}  // namespace stillpoint
