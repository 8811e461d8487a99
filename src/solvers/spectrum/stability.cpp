#include <stillpoint/stability.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "linalg/power_iteration.hpp"

namespace stillpoint {
namespace {

// Stable means a growth per step of at most this. If |R(iy)| leaves 1 at once but slowly (orders 5 and 6: like y⁶), the
// limit is where the growth passes it: 0.02 … 0.04 for Cash–Karp and similar methods.
constexpr double growth = 1e-12;
// The scan in r = h |λ|: its first value, its ratio, and the value at which the search for a limit is given up. A
// method that is unstable at the start has no stable step: Heun–Euler on the imaginary axis. Beside a large damping
// rate leapfrog's limit is still 2/omega, at a large r: a method without a limit there is scanned again in r = h omega,
// with a rate at which growth can still be told from rounding.
constexpr double r_first = 0.01, r_ratio = 1.02, r_last = 1e3, most_rate = 1e6;

// The larger |λ| of the two roots of λ² + rate λ + omega² = 0.
double spectral_radius(double omega, double rate) {
  const double half = rate / 2;
  return half <= omega ? omega : half * (1 + std::sqrt((1 - omega / half) * (1 + omega / half)));
}

// The largest h ≤ h_max such that every step of a scan from h_first to h is stable; h_max if none fails.
double scan(const AmplificationRadius& amplification, double omega, double rate, double h_first, double h_max) {
  const auto stable = [&](double h) { return amplification(h, omega, rate) <= 1 + growth; };  // false for NaN
  double good = 0, bad = std::min(h_max, h_first);
  while (stable(bad)) {
    if (bad >= h_max) return h_max;
    good = bad;
    bad = std::min(h_max, bad * r_ratio);
  }
  if (good == 0) return 0;
  while (bad - good > 1e-12 * bad) {
    const double middle = (good + bad) / 2;
    (stable(middle) ? good : bad) = middle;
  }
  return good;
}

double largest_stable_step(const AmplificationRadius& amplification, double omega, double rate, double h_max) {
  const double radius = spectral_radius(omega, rate), past_damping = std::min(h_max, r_last / radius);
  const double h = scan(amplification, omega, rate, r_first / radius, past_damping);
  if (h < past_damping || h >= h_max) return h;
  return scan(amplification, omega, std::min(rate, most_rate * omega), std::max(h, r_first / omega), h_max);
}

// Values a = x_0 < … < x_m = b in geometric progression, each x_k/x_{k−1} ≤ ratio and at least `fewest` of them; a ≥ 0.
// If a = 0 it is kept, and the progression starts from b·1e-4. One value if a = b.
std::vector<double> geometric_grid(double a, double b, double ratio, int fewest) {
  if (!(a < b)) return {b};
  std::vector<double> grid;
  if (a == 0) grid.push_back(0);
  const double low = a > 0 ? a : 1e-4 * b;
  const int parts = std::max(fewest, static_cast<int>(std::ceil(std::log(b / low) / std::log(ratio))));
  for (int k = 0; k < parts; ++k) grid.push_back(low * std::pow(b / low, static_cast<double>(k) / parts));
  grid.push_back(b);
  return grid;
}

// The extreme eigenvalues of M [kg]: those of the diagonal if lumped. If consistent, they come from power iteration on
// M from below and on M⁻¹ from above, until the estimated error is 0.1 %, with 1 % added for what the estimate may
// miss.
std::pair<double, double> extreme_masses(const Mass& mass) {
  if (mass.size() == 0) return {1, 1};
  if (mass.is_diagonal()) {
    const auto [smallest, largest] = std::minmax_element(mass.diagonal().begin(), mass.diagonal().end());
    return {*smallest, *largest};
  }
  constexpr double tolerance = 1e-3, margin = 1.01;
  constexpr int max_iterations = 500;
  const LinearMap identity = [](ConstVec x, Vec y) { std::copy(x.begin(), x.end(), y.begin()); };
  const LinearMap product = [&](ConstVec x, Vec y) { mass.apply(x, y); };
  const LinearMap solve = [&](ConstVec x, Vec y) { mass.solve(x, y); };
  const double largest = power_iteration(mass.size(), product, identity, tolerance, max_iterations).eigenvalue;
  const double smallest = 1 / power_iteration(mass.size(), identity, solve, tolerance, max_iterations).eigenvalue;
  return {smallest / margin, largest * margin};
}

}  // namespace

DampedSpectrum damped_spectrum(double omega_1, double omega_max, const Damping& damping, const Mass& mass) {
  const LinearDamping C = damping.linear();
  DampedSpectrum spectrum{omega_1, omega_max, C.mass, C.mass, damping.stiffness_factor()};
  if (C.identity != 0) {  // rate = vᵀCv/vᵀMv = c_m + c_i vᵀv/vᵀMv
    const auto [smallest, largest] = extreme_masses(mass);
    spectrum.rate_min += C.identity / largest;
    spectrum.rate_max += C.identity / smallest;
  }
  return spectrum;
}

double critical_step(const AmplificationRadius& amplification, const DampedSpectrum& spectrum) {
  // Omega and rate are scanned from the highest down, as those limit the step most: later scans need to go no further
  // than the least limit so far.
  const double omega_max = spectrum.omega_max * std::sqrt(spectrum.stiffness_factor);
  if (!(omega_max > 0)) return std::numeric_limits<double>::infinity();
  const double omega_min = spectrum.omega_1 > 0 ? spectrum.omega_1 : 1e-4 * spectrum.omega_max;
  const std::vector<double> omegas = geometric_grid(std::min(omega_min, omega_max), omega_max, 1.05, 1);
  const std::vector<double> rates = geometric_grid(spectrum.rate_min, spectrum.rate_max, 2, 8);
  double h = std::numeric_limits<double>::infinity();
  for (std::size_t i = omegas.size(); i-- > 0;) {
    for (std::size_t j = rates.size(); j-- > 0;) {
      const double h_max = std::min(h, r_last / omegas[i]);
      const double limit = largest_stable_step(amplification, omegas[i], rates[j], h_max);
      if (limit < h_max) h = limit;  // else it is stable as far as needed, or no limit was found up to r_last
    }
  }
  return h;
}

namespace {

// Whether no motion grows: compares the largest ‖y‖ in the first and in the second half of many steps, for phases all
// around half the circle. The other half is the same with all signs changed, and lengths do not matter:
// D(v, s Q) = s D(v, Q).
bool every_phase_decays(const OscillatorStep& step, const Damping& local, double h) {
  constexpr std::size_t phases = 24;
  constexpr int steps = 200;
  constexpr double rounding = 1e-9;
  Oscillators all;
  for (std::size_t k = 0; k < phases; ++k) {
    const double phase = std::numbers::pi * (static_cast<double>(k) + 0.5) / phases;
    all.u.push_back(std::cos(phase));
    all.v.push_back(std::sin(phase));
  }
  struct Size {
    double log = 0, before = 0, after = -std::numeric_limits<double>::infinity();
  };
  std::array<Size, phases> sizes;
  for (int n = 0; n < steps; ++n) {
    step(h, local, all);
    for (std::size_t k = 0; k < phases; ++k) {
      const double length = std::hypot(all.u[k], all.v[k]);
      if (length == 0) continue;  // it rests
      if (!std::isfinite(length)) return false;
      sizes[k].log += std::log(length);
      double& most = n < steps / 2 ? sizes[k].before : sizes[k].after;
      most = std::max(most, sizes[k].log);
      all.u[k] /= length;
      all.v[k] /= length;
    }
  }
  // D has no effect on some motions
  return std::ranges::none_of(sizes, [](const Size& size) { return size.after > size.before + rounding; });
}

}  // namespace

double switched_stability_limit(const OscillatorStep& step, const Damping& local) {
  constexpr double first = 0.2, ratio = 1.02, last = 100, accuracy = 1e-3;
  double good = 0, bad = first;
  while (every_phase_decays(step, local, bad)) {
    good = bad;
    bad *= ratio;
    if (bad > last) return last;
  }
  while (good > 0 && bad - good > accuracy * bad) {
    const double middle = (good + bad) / 2;
    (every_phase_decays(step, local, middle) ? good : bad) = middle;
  }
  return good;
}

double stability_limit(const AmplificationRadius& amplification, double zeta) {
  const double r = largest_stable_step(amplification, 1, 2 * zeta, r_last);
  return r < r_last ? r : std::numeric_limits<double>::infinity();
}

}  // namespace stillpoint
