// Drucker–Prager plasticity, rate-independent or viscous, with a tension cut-off that opens a gap. Tension is positive.
//   f = √J₂ + η p − ξ c,   p = tr σ/3,   flow by √J₂ + η̄ p:   dᵖ = γ̇ᵖ (s/(2 √J₂) + η̄/3 I)
// γᵖ, the plastic strain, is conjugate to √J₂ (s : dᵖ = √J₂ γ̇ᵖ): in simple shear the plastic part of γ. Either f ≤ 0,
// or γ̇ᵖ = β f [Perzyna 1966] with the fluidity β. Return mapping: [de Souza Neto, Perić and Owen 2008, §8.3].
//
// An increment [Hughes and Winget 1980], f = I + H from the last to the next, g = f − dH/2 between them:
//   l = dH g⁻¹ = d + w,   σ_trial = R½ (R½ σ R½ᵀ + C : d) R½ᵀ,   R½ R½ = R the Cayley transform of w,
// so that a rotation turns the stress exactly and the error of any other path is of second order.
//
// Volume. Where the cone has returned a trial to more tension than p_cut ≤ ξ c/η (the apex), p stays at p_cut, and what
// opens is kept as a gap, a volumetric strain that closes before p can fall again. With σ = 0 in it, a cohesionless
// point flies apart and comes back without having grown. All volume is accounted for:
//   tr d = Δp/K + Δgap + η̄ Δγᵖ.
// So dilatancy first takes its volume out of an open gap, and presses only when that is closed. The edge between cone
// and cut-off is Koiter's: the apex is the edge at p_cut = ξ c/η, √J₂ = 0.
//
// Softening: η and ξ c fall linearly with γᵖ from their peak to their residual values at γᵖ = softening_strain. The
// strength is that of the committed γᵖ, one increment late, so that the return stays closed.
#pragma once

#include <stillpoint/drucker_prager_parameters.hpp>
#include <stillpoint/plane_tensor.hpp>

#include <algorithm>
#include <cmath>

namespace stillpoint {

template <StressState S>
class DruckerPrager {
  static_assert(S == StressState::plane_strain || S == StressState::axisymmetric);
  static constexpr bool axisymmetric = S == StressState::axisymmetric;

 public:
  static constexpr StressState state = S;
  static constexpr int history = 6;
  static constexpr std::array<std::string_view, history> history_names = {"", "", "", "", "gap", "plastic_strain"};
  using History = std::array<double, history>;  // σ_xx, σ_yy, σ_zz, σ_xy [Pa], gap, γᵖ

  explicit DruckerPrager(const DruckerPragerParameters& m)
      : K_(m.E / (3 * (1 - 2 * m.nu))), G_(m.E / (2 * (1 + m.nu))), fluidity_(m.fluidity), tension_(m.tension) {
    const ConeCoefficients peak = cone_coefficients(m.cone, m.phi, m.psi);
    const ConeCoefficients residual = cone_coefficients(m.cone, m.phi_residual.value_or(m.phi), m.psi);
    eta_ = peak.eta;
    k_ = peak.xi * m.c;
    eta_bar_ = peak.eta_bar;
    eta_lost_ = residual.eta - eta_;
    k_lost_ = residual.xi * m.c_residual.value_or(m.c) - k_;
    softening_rate_ = m.softening_strain > 0 ? 1 / m.softening_strain : 0;
  }

  // P = det(f) σ f⁻ᵀ after the increment; next: the committed history, which is advanced. NaN where det f ≤ 0.
  Gradient<S> first_piola(const Gradient<S>& H, const Gradient<S>& dH, double dt, History& next) const {
    const auto [xx, yy, zz, xy, gap, plastic] = next;

    // g = f − dH/2,  l = dH g⁻¹
    const double fxx = 1 + H[0], fxy = H[1], fyx = H[2], fyy = 1 + H[3];
    const double gxx = fxx - dH[0] / 2, gxy = fxy - dH[1] / 2, gyx = fyx - dH[2] / 2, gyy = fyy - dH[3] / 2;
    const double det_g = gxx * gyy - gxy * gyx, r = 1 / det_g;
    const double lxx = r * (dH[0] * gyy - dH[1] * gyx), lxy = r * (dH[1] * gxx - dH[0] * gxy);
    const double lyx = r * (dH[2] * gyy - dH[3] * gyx), lyy = r * (dH[3] * gxx - dH[2] * gxy);
    const double dzz = hoop_rate(H, dH);
    const double tr_d = lxx + lyy + dzz;

    // tan(θ/2) = q = (l_yx − l_xy)/4 for the increment's rotation θ
    const double q = (lyx - lxy) / 4, u = 1 / (1 + q * q);
    const double cos1 = (1 - q * q) * u, sin1 = 2 * q * u, cos2 = 1 - 2 * sin1 * sin1, sin2 = 2 * sin1 * cos1;

    // half difference and shear turn by twice the angle
    const double half0 = (xx - yy) / 2, dhalf = G_ * (lxx - lyy), dshear = G_ * (lxy + lyx);
    const double half = cos2 * half0 - sin2 * xy + (cos1 * dhalf - sin1 * dshear);
    const double shear = sin2 * half0 + cos2 * xy + (sin1 * dhalf + cos1 * dshear);
    const double p0 = (xx + yy + zz) * (1.0 / 3);
    const double szz = zz - p0 + 2 * G_ * (dzz - tr_d * (1.0 / 3));
    const double p_trial = p0 + K_ * (tr_d + gap);

    // strength
    const double lost = plastic * softening_rate_, share = lost < 1 ? lost : 1;
    const double eta = eta_ + share * eta_lost_, k = k_ + share * k_lost_;
    const double apex = k / (eta + tiny), p_cut = tension_ < apex ? tension_ : apex;

    // return
    const double radius = std::sqrt(half * half + shear * shear + 0.75 * (szz * szz) + tiny);
    const double viscous = fluidity_ > 0 ? 1 / (fluidity_ * dt) : 0;
    const double excess = positive(radius + eta * p_trial - k);
    const double cone = excess * (1 / (G_ + viscous + K_ * eta * eta_bar_));
    const double p_cone = p_trial - K_ * eta_bar_ * cone;
    const bool open = p_cone > p_cut;
    const double edge = positive(radius + eta * p_cut - k) * (1 / (G_ + viscous));
    const double gamma = open ? edge : cone;
    const double p = open ? p_cut : p_cone;
    const double inverse_radius = 1 / radius;
    const double scale = 1 - G_ * gamma * inverse_radius;

    const double z = szz * scale, h = half * scale, t = shear * scale, mean = p - z / 2;
    const double nxx = mean + h, nyy = mean - h, nzz = p + z;
    next[0] = nxx;
    next[1] = nyy;
    next[2] = nzz;
    next[3] = t;
    next[4] = open ? gap + tr_d + (p0 - p_cut) * (1 / K_) - eta_bar_ * gamma : 0;
    next[5] = plastic + gamma;

    const double det_f = fxx * fyy - fxy * fyx;
    if constexpr (axisymmetric) {
      const double hoop = 1 + H[4];
      const double s = det_f > 0 && det_g > 0 && hoop > 0 ? t : nan;
      return {hoop * (nxx * fyy - s * fxy), hoop * (s * fxx - nxx * fyx), hoop * (s * fyy - nyy * fxy),
              hoop * (nyy * fxx - s * fyx), nzz * det_f};
    } else {
      const double s = det_f > 0 && det_g > 0 ? t : nan;
      return {nxx * fyy - s * fxy, s * fxx - nxx * fyx, s * fyy - nyy * fxy, nyy * fxx - s * fyx};
    }
  }

  Stress<S> cauchy(const History& h) const { return {h[0], h[1], h[2], h[3]}; }
  History initial_history(const Stress<S>& s) const { return {s[0], s[1], s[2], s[3], 0, 0}; }

  Moduli<S> moduli(const Gradient<S>& H, const History& now) const {
    const PlaneTensor F = deformation_gradient<S>(H), sigma{now[0], now[3], now[3], now[1], now[2]};
    const double J = volume_ratio(F);
    return moduli_of_rate<S>(F, J * sigma, [&](const PlaneTensor& l) {
      const PlaneTensor d = 0.5 * (l + transpose(l)), w = l - d;
      return J * ((K_ - 2 * G_ / 3) * trace(d) * identity + 2 * G_ * d + w * sigma - sigma * w);
    });
  }

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double tiny = 1e-300;
  static double positive(double x) { return x > 0 ? x : 0; }
  static double hoop_rate(const Gradient<S>& H, const Gradient<S>& dH) {
    if constexpr (axisymmetric) {
      return dH[4] / (1 + H[4] - dH[4] / 2);
    } else {
      return 0;
    }
  }
  double K_, G_, fluidity_, tension_;
  double eta_, k_, eta_bar_, eta_lost_, k_lost_, softening_rate_;
};

}  // namespace stillpoint
