// Local damping multiplies the force of each degree of freedom by a factor d_i between 1 − α and 1 or 1 + α, so that
// M a = −d K u. In the energy norm no such motion is stiffer than
//
//   ω² = max_x max_d xᵀK M⁻¹ d K x/xᵀKx,   d_i the largest where (Kx)_i (M⁻¹Kx)_i > 0, else the smallest,
//
// which for a diagonal M is ω_max² times the largest d. It is found like ω_max, by x ← ½ (M⁻¹ d K x + d M⁻¹ K x), the
// power iteration of the symmetric part, with the d that belongs to the present x.
#include "solvers/spectrum/local_damping_gain.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linalg/power_iteration.hpp"

namespace stillpoint {
namespace {

// The smallest |Q + D|/|Q|: that of a motion along Q or, if D also depends on dQ/dt, as far below 1 as the largest is
// above.
double smallest_factor(const Damping& damping) {
  const double v = 1;
  double Q = 1;
  damping.add_local({&v, 1}, {&Q, 1});
  return std::min(Q, 2 - damping.stiffness_factor());
}

}  // namespace

double local_damping_gain(const SemiDiscrete& system, double t, ConstVec u, const Damping& damping, double omega_max) {
  const Mass& mass = system.mass();
  if (!damping.is_local() || mass.is_lumped()) return 1;
  constexpr int most_iterations = 300;
  constexpr double accuracy = 1e-5;  // change in one iteration
  const double largest = damping.stiffness_factor(), smallest = smallest_factor(damping);
  const std::size_t n = system.size();
  std::vector<double> x = start_vector(n), Kx(n), z(n), dKx(n), next(n);
  double omega_squared = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    system.tangents().apply(Tangent::stiffest, t, u, x, Kx);
    mass.solve(Kx, z);
    double energy = 0, sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double d = Kx[i] * z[i] > 0 ? largest : smallest;
      energy += x[i] * Kx[i];
      sum += d * Kx[i] * z[i];
      dKx[i] = d * Kx[i];
      z[i] *= d;
    }
    const double last = omega_squared;
    omega_squared = std::max(last, sum / energy);
    mass.solve(dKx, next);
    double length = 0;
    for (std::size_t i = 0; i < n; ++i) {
      next[i] = (next[i] + z[i]) / 2;
      length = std::max(length, std::abs(next[i]));
    }
    for (std::size_t i = 0; i < n; ++i) x[i] = next[i] / length;
    if (iteration > 20 && omega_squared - last <= accuracy * omega_squared) break;
  }
  return std::max(1.0, std::sqrt(omega_squared / largest) / omega_max);
}

}  // namespace stillpoint
