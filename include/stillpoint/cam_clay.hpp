// Modified Cam clay [Roscoe and Burland 1968; Wood 1990, Soil Behaviour and Critical State Soil Mechanics, §5]. Here
// compression is positive, as in soil mechanics; the stress in the history has tension positive. With p = −tr σ/3, the
// deviator s, q = √(3/2) |s| and the specific volume v = 1 + e,
//
//   q²/M² + p (p − p_c) ≤ 0,   flow along its gradient,
//   K = v p/κ,   G = r K,   r = 3 (1 − 2ν)/(2 (1 + ν)),   ṗ_c/p_c = v ε̇_vᵖ/(λ − κ),
//
// with v = 1 + e of now, or v = 1 + e_0 if the volume is fixed.
//
// Increments. The relation of p, p_c and the volume is exact in any increment, as it is one of states,
//
//   κ Δln p + (λ − κ) Δln p_c = Y,   Y = ∫ v dε_v = −Δv, or −v Δln J if v is fixed.
//
// Elastic ones are exact along a straight path of strain: p grows by e^(Y/κ), and s changes in proportion to p, so that
// the path in (p, s) is straight and meets the ellipse at the root of a quadratic equation. From there on the stress
// ratio follows cam_clay_flow.hpp.
//
// A trial that loads or unloads by far more than κ, or shears beyond what the flow resolves, gives NaN: a smaller step
// follows it.
#pragma once

#include <stillpoint/cam_clay_flow.hpp>
#include <stillpoint/exponential.hpp>
#include <stillpoint/logarithm.hpp>
#include <stillpoint/principal_stresses.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/stress_history.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stillpoint {

struct CamClayParameters {
  static constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

  double M, lambda, kappa, nu;
  double e0;                               // void ratio at the start
  double OCR = not_given, pc = not_given;  // one of them; p_c [Pa]
  bool volume_evolves = true;

  static CamClayParameters from(const MaterialSpec& material) {
    const auto value = [&](const char* key) { return material.parameters.at(key); };
    return {.M = value("M"),
            .lambda = value("lambda"),
            .kappa = value("kappa"),
            .nu = value("nu"),
            .e0 = value("e0"),
            .OCR = value("OCR"),
            .pc = value("pc"),
            .volume_evolves = material.choices.at("volume") == "evolves"};
  }

  /// r = G/K
  double shear_ratio() const { return 1.5 * (1 - 2 * nu) / (1 + nu); }
  /// η = q/p of normally consolidated ground whose sides do not move, where ε_s = 2/3 ε_v:
  ///   κ η/(3 r) + 2 (λ − κ) η/(M² − η²) = 2/3 λ
  double eta_at_rest() const {
    double below = 0, above = M;
    for (int k = 0; k < 60; ++k) {
      const double eta = (below + above) / 2;
      const double shear = kappa * eta / (3 * shear_ratio()) + 2 * (lambda - kappa) * eta / (M * M - eta * eta);
      (shear > 2.0 / 3 * lambda ? above : below) = eta;
    }
    return (below + above) / 2;
  }
  /// p_c of such ground over its vertical stress σ_v = p + 2/3 q.
  double pc_at_rest() const {
    const double eta = eta_at_rest();
    return (1 + eta * eta / (M * M)) / (1 + 2 * eta / 3);
  }
};

/// The internal variables are p_c [Pa], the void ratio e = v − 1, which is followed with a fixed v too, and the plastic
/// strain ∫ √(2 dᵖ:dᵖ) dt, in simple shear the plastic part of γ.
template <StressState S>
class CamClay : public StressHistory<CamClay<S>, S, 3> {
  using Base = StressHistory<CamClay<S>, S, 3>;

 public:
  using typename Base::History, typename Base::Internal;
  static constexpr auto history_names = Base::names_of_history({"pc", "void_ratio", "plastic_strain"});
  static constexpr bool needs_pressure = true;

  explicit CamClay(const CamClayParameters& m)
      : of_shear_(3 / (m.M * m.M)),
        kappa_(m.kappa),
        r_(m.shear_ratio()),
        flow_{2 * m.shear_ratio() * of_shear_, m.kappa / (m.lambda - m.kappa)},
        e0_(m.e0),
        OCR_(m.OCR),
        pc_(m.pc),
        pc_at_rest_(m.pc_at_rest()),
        evolving_(m.volume_evolves ? 1 : 0),
        fixed_(1 - evolving_) {}

  template <class Number>
  [[gnu::always_inline]] StressAfter<S, Number, 3> advanced(const GradientOf<S, Number>& H,
                                                            const GradientOf<S, Number>& dH, const Stress<S>& sigma,
                                                            const Internal& internal, double /*dt*/) const {
    using std::sqrt;
    const double pc = internal[0], v = 1 + internal[1];
    GradientOf<S, Number> before = H;
    unroll<gradient_components(S)>([&](auto c) __attribute__((always_inline)) { before[c] = H[c] - dH[c]; });
    const Number J_before = volume_ratio<S, Number>(before), over = 1 / J_before;
    const Number growth = (volume_ratio<S, Number>(H) - J_before) * over;

    // y = Y/κ, and the v that takes a strain into ∫ v dε, to second order; products with 0 and 1, as a condition that
    // is the same for all points keeps a loop from being vectorised
    const Number ratio = 1 + growth, mean_v = evolving_ * (v * (1 + growth / 2)) + fixed_ * (1 + e0_);
    const Number y = (-1 / kappa_) * (evolving_ * (v * growth) + (fixed_ * (1 + e0_)) * logarithm_of(ratio, growth));

    const double y_now = value_of(y);

    // The elastic end: p e^y and s + p ψ d, with d = 2 (r v/κ) dev e and ψ = (e^y − 1)/y
    const Increment<S, Number> increment(H, dH);
    const double p = (sigma[0] + sigma[1] + sigma[2]) * (-1.0 / 3);
    const DeviatorOf<S, Number> s = increment.turned_stress(sigma, -p);
    const DeviatorOf<S, Number> d = increment.turned_stretch(Number((r_ / kappa_) * mean_v));
    const Number grown = exponential_minus_1(y);
    const bool is_still = (y_now > -small) & (y_now < small);
    const Number divisor = either(is_still, Number(1), y);
    const Number psi = either(is_still, Number(1 + y / 2), Number(grown / divisor)), whole = p * psi;
    const Number p_trial = p + p * grown;

    // q²/M² = of_shear J₂ along s + b d
    const Number J_ss = of_shear_ * second_invariant(s), J_sd = of_shear_ * second_invariant(s, d),
                 J_dd = of_shear_ * second_invariant(d);
    const Number f_trial = J_ss + whole * (2 * J_sd + whole * J_dd) + p_trial * (p_trial - pc);
    const bool yields = value_of(f_trial) > rounding * pc * pc;

    // The share φ of the elastic path up to the ellipse, A φ² + 2 B φ + C = 0, and what is left of the time
    const Number rise = p * grown, A = whole * whole * J_dd + rise * rise, B = whole * J_sd + rise * (p - pc / 2);
    const Number outside = J_ss + p * (p - pc), C = either(outside > Number(0), Number(0), outside);
    const Number root = sqrt(B * B - A * C + rounding * rounding * pc * pc * pc * pc);
    const bool outwards = B > Number(0);
    const Number phi = either(outwards, Number(-C), Number(root - B)) / either(outwards, Number(root + B), A);
    const Number phi_grown = phi * grown;
    const Number series = phi * (1 + (1 - phi) * y * (0.5 + (1 - 2 * phi) * y * (1.0 / 6)));
    const bool is_slow = (y_now > -slow) & (y_now < slow);
    const Number time = either(is_slow, series, Number(logarithm_of(1 + phi_grown, phi_grown) / divisor));
    const Number left = 1 - time, p_yield = p + p * phi_grown, over_p = 1 / p_yield;

    // The flow, from ξ_0 = (s + b d)/p on
    const Number b = phi * whole, along = left * over_p;
    const CamClayRatio<Number> end =
        flow_.flow(CamClayRates<Number>{.xi_xi = (J_ss + b * (2 * J_sd + b * J_dd)) * (over_p * over_p),
                                        .xi_a = (J_sd + b * J_dd) * along,
                                        .a_a = J_dd * left * left,
                                        .y = left * y});
    const Number of_s = end.alpha * over_p, of_d = of_s * b + end.beta * left;               // ξ = of_s s + of_d d
    const Number ellipse = 1 + J_ss * of_s * of_s + of_d * (2 * J_sd * of_s + J_dd * of_d);  // 1 + u²

    // p = p_trial e^(−X/κ), p_c = p_cn e^(X/(λ − κ)) = p (1 + u²) with the plastic share X of Y
    const Number from_pc = p_trial * ellipse * (1 / pc);
    const Number p_flow = p_trial * exponential((-1 / (1 + flow_.rho)) * logarithm_of(from_pc, from_pc - 1));

    const bool resolved = end.fastest <= CamClayFlow::most_g;
    const bool in_reach = (y_now > -most_y) & (y_now < most_y) & (resolved | !yields);
    const Number nan = std::numeric_limits<double>::quiet_NaN();
    const Number pressure = either(in_reach, either(yields, p_flow, p_trial), nan);
    const Number share_s = either(yields, Number(p_flow * of_s), Number(1)),
                 share_d = either(yields, Number(p_flow * of_d), whole);
    const double next_pc = yields ? value_of(p_flow) * value_of(ellipse) : pc;
    // dᵖ = κ n/v of the ellipse's gradient, (1 − u²)/3 I − √6/M ξ
    const double u2 = value_of(ellipse) - 1, gradient = (1 - u2) * (1 - u2) * (1.0 / 3) + 2 * of_shear_ * u2;
    const double flown = kappa_ * end.flown * sqrt(2 * gradient) / value_of(mean_v);
    return {stress_of(Number(-pressure), sum(share_s, s, share_d, d)),
            {next_pc, v * value_of(ratio) - 1, internal[2] + (yields ? flown : 0)},
            increment.det_g};
  }

  /// p_c of a point: as given; or OCR times that of the ellipse through the stress. Of ground at rest, OCR times that
  /// of normally consolidated ground under the same vertical stress, and no less than the ellipse through the stress:
  /// σ_v OCR is the largest vertical stress that the ground has borne.
  Internal initial_internal(const Stress<S>& sigma, const InitialPoint& point) const {
    const double p = (sigma[0] + sigma[1] + sigma[2]) * (-1.0 / 3);
    const double through = p > 0 ? p + of_shear_ * second_invariant(deviator_of<S>(sigma, -p)) / p : 0;
    const double e0 = point.void_ratio * e0_;
    if (!std::isnan(pc_)) return {point.consolidation * pc_, e0, 0};
    const double OCR = point.consolidation * OCR_;
    return {point.at_rest ? std::max(OCR * pc_at_rest_ * -sigma[1], through) : OCR * through, e0, 0};
  }
  IsotropicModuli elasticity(const Stress<S>& sigma, const Internal& internal) const {
    const double p = (sigma[0] + sigma[1] + sigma[2]) * (-1.0 / 3), v = 1 + evolving_ * internal[1] + fixed_ * e0_;
    const double K = v * p / kappa_;
    return {K, r_ * K};
  }

  bool stress_stays() const { return true; }
  bool is_viscous() const { return false; }
  YieldState yield_state(const History& now) const {
    const Stress<S> sigma = Base::cauchy(now);
    const double p = (sigma[0] + sigma[1] + sigma[2]) * (-1.0 / 3), pc = now[Base::stresses];
    const double root_J2 = std::sqrt(second_invariant(deviator_of<S>(sigma, -p)));
    const double square = p * (pc - p) / of_shear_,
                 strength = std::sqrt(std::abs(square));  // under p > p_c there is none
    return {.f = square < 0 ? root_J2 + strength : root_J2 - strength,
            .strength = square < 0 ? 0 : strength,
            .root_J2 = root_J2};
  }

 private:
  template <class Number>
  [[gnu::always_inline]] static PlaneDeviator<Number> sum(const Number& a, const PlaneDeviator<Number>& s,
                                                          const Number& b, const PlaneDeviator<Number>& d) {
    return {a * s.half + b * d.half, a * s.shear + b * d.shear, a * s.zz + b * d.zz};
  }
  template <class Number>
  [[gnu::always_inline]] static SpaceTensorOf<Number> sum(const Number& a, const SpaceTensorOf<Number>& s,
                                                          const Number& b, const SpaceTensorOf<Number>& d) {
    const Number xy = a * s.xy + b * d.xy, yz = a * s.yz + b * d.yz, zx = a * s.zx + b * d.zx;
    return {a * s.xx + b * d.xx, xy, zx, xy, a * s.yy + b * d.yy, yz, zx, yz, a * s.zz + b * d.zz};
  }

  static constexpr double small = 1e-8;  // y below which e^y − 1 = y + y²/2 to rounding
  static constexpr double slow = 1e-5;   // y below which the series of ln(1 + φ (e^y − 1))/y is exact to rounding
  static constexpr double most_y = 10;   // e^y of an elastic trial that is in reach
  static constexpr double rounding = 1e-14;  // of f, as a share of p_c²

  double of_shear_;  // 3/M²
  double kappa_, r_;
  CamClayFlow flow_;
  double e0_, OCR_, pc_;
  double pc_at_rest_;        // over the vertical stress
  double evolving_, fixed_;  // 1 and 0, or 0 and 1
};

}  // namespace stillpoint
