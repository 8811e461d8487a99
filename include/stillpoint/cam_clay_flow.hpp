// Plastic flow of Modified Cam clay under a constant rate of strain, in the stress ratio.
//
// With compression positive, p the mean stress, s the deviator and ξ = √(3/2) s/(M p), so that u = |ξ| is 1 in the
// critical state, the state lies on the ellipse p (1 + u²) = p_c. Strain increments are ε_v of the volume and e of the
// shape. With G = r K, K = v p/κ, the elastic law, the flow rule and the hardening of p_c are
//
//   ṗ/p = v (ε̇_v − ε̇_vᵖ)/κ,   ṡ = 2 G (ė − ėᵖ),   ṗ_c/p_c = v ε̇_vᵖ/(λ − κ),   v ε̇_vᵖ = κ n (1 − u²),
//   ξ̇ = a − g ξ,   g = y + (C − (1 − u²)) n,   C = 6 r/M²,   y = v ε̇_v/κ,   a = √(3/2) (2 r v/(κ M)) ė,
//   n = (y (1 − u²) + 2 ξ·a)/((1 + ρ) + 2 (C − 1) u² + (1 − ρ) u⁴),   ρ = κ/(λ − κ),
//
// where n follows from the ellipse. y and a are constant along a straight path of strain if time is measured by
// ∫ v dε_v. Then ξ stays in the plane of its first value ξ_0 and a: ξ = α ξ_0 + β a, α̇ = −g α, β̇ = 1 − g β, and the
// three products of ξ_0 and a are all that counts. What becomes of p and p_c needs no integration (cam_clay.hpp).
#pragma once

#include <stillpoint/dual.hpp>
#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>

namespace stillpoint {

/// The products of the first stress ratio ξ_0 and of a, the elastic increment of ξ, and y = v Δε_v/κ.
template <class Number>
struct CamClayRates {
  Number xi_xi, xi_a, a_a, y;
};

/// ξ = alpha ξ_0 + beta a at the end.
template <class Number>
struct CamClayRatio {
  Number alpha, beta;
  double fastest;  // the largest |g| on the way, by which an explicit method is stable
  double flown;    // ∫ n
};

struct CamClayFlow {
  double C, rho;

  /// Steps of the classical method of order 4 in one increment: of clay from p = p_c with κ = 0.04 an undrained 1 % of
  /// strain has an error of 2e-5 with three of them, and of 1e-3 with one. Beyond |g| = most_g it is not stable.
  static constexpr int steps = 3;
  static constexpr double most_g = 2.0 * steps;

  template <class Number>
  [[gnu::always_inline]] CamClayRatio<Number> flow(const CamClayRates<Number>& rates) const {
    constexpr double h = 1.0 / steps;
    Number alpha = 1, beta = 0;
    double fastest = 0, flown = 0;
    const auto g_at = [&](const Number& al, const Number& be, double weight) __attribute__((always_inline)) {
      const Number u2 = al * al * rates.xi_xi + 2 * al * be * rates.xi_a + be * be * rates.a_a;
      const Number xi_a = al * rates.xi_a + be * rates.a_a, dry = 1 - u2;
      const Number n = (rates.y * dry + 2 * xi_a) / ((1 + rho) + u2 * (2 * (C - 1) + (1 - rho) * u2));
      const Number g = rates.y + (C - dry) * n;
      const double size = value_of(g) < 0 ? -value_of(g) : value_of(g);
      fastest = size <= fastest ? fastest : size;  // NaN stays
      flown += weight * value_of(n);
      return g;
    };
    unroll<steps>([&](auto) __attribute__((always_inline)) {
      const Number g1 = g_at(alpha, beta, h / 6), a1 = -g1 * alpha, b1 = 1 - g1 * beta;
      const Number alpha2 = alpha + h / 2 * a1, beta2 = beta + h / 2 * b1;
      const Number g2 = g_at(alpha2, beta2, h / 3), a2 = -g2 * alpha2, b2 = 1 - g2 * beta2;
      const Number alpha3 = alpha + h / 2 * a2, beta3 = beta + h / 2 * b2;
      const Number g3 = g_at(alpha3, beta3, h / 3), a3 = -g3 * alpha3, b3 = 1 - g3 * beta3;
      const Number alpha4 = alpha + h * a3, beta4 = beta + h * b3;
      const Number g4 = g_at(alpha4, beta4, h / 6), a4 = -g4 * alpha4, b4 = 1 - g4 * beta4;
      alpha = alpha + h / 6 * (a1 + 2 * (a2 + a3) + a4);
      beta = beta + h / 6 * (b1 + 2 * (b2 + b3) + b4);
    });
    return {alpha, beta, fastest, flown};
  }

  /// The same for Duals: with the derivatives by the four rates, and the chain rule.
  template <std::size_t N>
  CamClayRatio<Dual<N>> flow(const CamClayRates<Dual<N>>& rates) const {
    const std::array<Dual<N>, 4> given = {rates.xi_xi, rates.xi_a, rates.a_a, rates.y};
    const auto by_rates = variables<4>({given[0].value, given[1].value, given[2].value, given[3].value});
    const auto [alpha, beta, fastest, flown] =
        flow<Dual<4>>(CamClayRates<Dual<4>>{by_rates[0], by_rates[1], by_rates[2], by_rates[3]});
    const auto chained = [&](const Dual<4>& f) {
      Dual<N> result(f.value);
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t k = 0; k < N; ++k) result.derivative[k] += f.derivative[a] * given[a].derivative[k];
      }
      return result;
    };
    return {chained(alpha), chained(beta), fastest, flown};
  }
};

}  // namespace stillpoint
