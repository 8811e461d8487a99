// Drucker–Prager plasticity, rate-independent or viscous, with a tension cut-off that opens a gap. Tension is positive.
//   f = √J₂ + η p − ξ c,   p = tr σ/3,   flow by √J₂ + η̄ p:   dᵖ = γ̇ᵖ (s/(2 √J₂) + η̄/3 I)
// The plastic strain γᵖ = ∫ γ̇ᵖ dt is conjugate to √J₂ (s : dᵖ = √J₂ γ̇ᵖ): in simple shear, the plastic part of γ.
// Either f ≤ 0, or γ̇ᵖ = β f if f > 0 [Perzyna 1966], by backward Euler.
// Return mapping: [de Souza Neto, Perić and Owen 2008, §8.3].
//
// An increment [Hughes and Winget 1980], with f = I + H at its end and g = f − dH/2 half-way:
//   l = dH g⁻¹ = d + w,   σ_trial = R σ Rᵀ + R½ (C : d) R½ᵀ,   R½ R½ = R the rotation by 2 arctan(w/2),
// so that a rotation turns the stress exactly, in any number of increments, and any other path is of second order.
//
// Volume. Where the cone would return the trial to a p above p_cut, p is p_cut, and what opens is kept as a gap: a
// volumetric strain that closes before p can fall again, so that loose material does not grow by flying apart and
// coming back. p_cut is at most ξ c/η, the apex. Every volume change goes into one of three,
//   tr d = Δp/K + Δgap + η̄ Δγᵖ,
// so dilatancy takes its room out of an open gap and presses only when that is closed. The edge between cone and
// cut-off is Koiter's, p = p_cut and √J₂ = ξ c − η p_cut; at the apex √J₂ = 0. The cut-off itself is never viscous.
//
// Softening: η and ξ c fall linearly from their peak to their residual values at γᵖ = softening_strain. The strength is
// that of the committed γᵖ, one increment late, so that the return stays closed.
#pragma once

#include <stillpoint/drucker_prager_cone.hpp>
#include <stillpoint/dual.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/tensor.hpp>

#include <cmath>
#include <limits>

namespace stillpoint {

struct DruckerPragerParameters {
  static constexpr double as_peak = std::numeric_limits<double>::quiet_NaN();

  double E, nu = 0;                                          // [Pa], [1]
  double phi = 0, psi = 0, c = 0;                            // friction and dilatancy [degrees], cohesion [Pa]
  Cone cone = Cone::plane_strain;                            // how the cone is matched to Mohr–Coulomb's φ, ψ and c
  double fluidity = 0;                                       // β [1/(Pa s)]; 0: rate-independent
  double tension = std::numeric_limits<double>::infinity();  // p_cut [Pa]; above the apex: the apex
  double phi_residual = as_peak, c_residual = as_peak;       // [degrees], [Pa]
  double softening_strain = 0;                               // γᵖ at which the residual values are reached; 0: never

  static DruckerPragerParameters from(const MaterialSpec& material) {
    const auto value = [&](const char* key) { return material.parameters.at(key); };
    return {.E = value("E"),
            .nu = value("nu"),
            .phi = value("phi"),
            .psi = value("psi"),
            .c = value("c"),
            .cone = cone_of(material.choices.at("cone")),
            .fluidity = value("fluidity"),
            .tension = value("tension"),
            .phi_residual = value("phi_residual"),
            .c_residual = value("c_residual"),
            .softening_strain = value("softening_strain")};
  }
};

template <StressState S>
class DruckerPrager {
  static_assert(S == StressState::plane_strain || S == StressState::axisymmetric || S == StressState::space,
                "the other states are not written");

 public:
  static constexpr StressState state = S;
  static constexpr int stresses = stress_components(S), history = stresses + 2;
  using History = std::array<double, history>;  // σ_xx, σ_yy, σ_zz, σ_xy, in space σ_yz, σ_zx [Pa]; gap, γᵖ
  static constexpr std::array<std::string_view, history> history_names = [] {
    std::array<std::string_view, history> names{};
    names[stresses] = "gap";
    names[stresses + 1] = "plastic_strain";
    return names;
  }();

  template <class Number>
  using Components = std::array<Number, gradient_components(S)>;  // components of H and P

  explicit DruckerPrager(const DruckerPragerParameters& m)
      : K_(m.E / (3 * (1 - 2 * m.nu))), G_(m.E / (2 * (1 + m.nu))), fluidity_(m.fluidity), tension_(m.tension) {
    const auto peak = ConeCoefficients::from(m.cone, m.phi, m.psi);
    const double phi_residual = std::isnan(m.phi_residual) ? m.phi : m.phi_residual;
    const double c_residual = std::isnan(m.c_residual) ? m.c : m.c_residual;
    const auto residual = ConeCoefficients::from(m.cone, phi_residual, m.psi);
    eta_ = peak.eta;
    eta_change_ = residual.eta - peak.eta;
    k_ = peak.xi * m.c;
    k_change_ = residual.xi * c_residual - k_;
    eta_bar_ = peak.eta_bar;
    softening_rate_ = m.softening_strain > 0 ? 1 / m.softening_strain : 0;
  }

  /// P at the end of the increment. Number: double, or a Dual, which carries derivatives through the return; the
  /// history holds plain values.
  template <class Number>
  Components<Number> first_piola(const Components<Number>& H, const Components<Number>& dH, double dt,
                                 History& next) const {
    if constexpr (S == StressState::space) {
      return in_space(H, dH, dt, next);
    } else {
      return in_the_plane(H, dH, dt, next);
    }
  }

  /// Whether a zero increment returns the committed stress: not under softening, as a step takes the strength at its
  /// start, and that at its end is lower.
  bool stress_stays() const { return softening_rate_ == 0; }
  bool is_viscous() const { return fluidity_ > 0; }
  /// The yield state on the cone; the cut-off is never exceeded.
  YieldState yield_state(const History& now) const {
    const double p = (now[0] + now[1] + now[2]) / 3, x = now[0] - p, y = now[1] - p, z = now[2] - p;
    double J2 = (x * x + y * y + z * z) / 2;
    for (int a = 3; a < stresses; ++a) J2 += now[a] * now[a];
    const auto [eta, k] = cone_at(now[stresses + 1]);
    const double root_J2 = std::sqrt(J2);
    return {.f = root_J2 + eta * p - k, .strength = k - eta * p, .root_J2 = root_J2};
  }
  static Stress<S> cauchy(const History& now) {
    Stress<S> sigma;
    for (int a = 0; a < stresses; ++a) sigma[a] = now[a];
    return sigma;
  }
  History initial_history(const Stress<S>& sigma) const {
    History first{};
    for (int a = 0; a < stresses; ++a) first[a] = sigma[a];
    return first;
  }

  /// The consistent tangent of the return mapping [Simo and Taylor 1985]: the derivative of first_piola() to rounding,
  /// H and dH changing alike. It is symmetric only without stress and plastic flow: a flow that is not associated makes
  /// it unsymmetric, and the elastic rate is one of σ and not of τ, which leaves a term of the size of σ/K.
  Moduli<S> moduli(const Gradient<S>& H, const Gradient<S>& dH, double dt, History now) const {
    constexpr std::size_t n = gradient_components(S);
    const auto P = first_piola(variables(H), variables(dH), dt, now);
    Moduli<S> A;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) A[n * a + b] = P[a].derivative[b];
    }
    return A;
  }

  // The elastic rate from the committed stress: δσ = C : d + w σ − σ w. The derivative of the trial also has the term σ
  // tr d, which is left out as if Jaumann's rate of τ were the elastic one: ∂P/∂H is then symmetric and frequencies are
  // real, at an error of σ/K.
  Gradient<S> elastic_rate(const Gradient<S>& H, const Gradient<S>& dH, const History& now) const {
    const ElasticTrial at(H, now);
    return stress_rate<S>(inverse(at.f), at.tau, rate_at(at), dH);
  }
  Moduli<S> elastic_moduli(const Gradient<S>& H, const History& now) const {
    const ElasticTrial at(H, now);
    return moduli_of_rate<S>(at.f, at.tau, rate_at(at));
  }

 private:
  using Tensor = TensorFor<S>;

  template <class Number>
  Components<Number> in_the_plane(const Components<Number>& H, const Components<Number>& dH, double dt,
                                  History& next) const {
    using std::sqrt;
    const auto [s_xx, s_yy, s_zz, s_xy, gap, plastic_strain] = next;

    // g = f − dH/2,  l = dH g⁻¹
    const Number gxx = 1 + H[0] - dH[0] / 2, gxy = H[1] - dH[1] / 2, gyx = H[2] - dH[2] / 2, gyy = 1 + H[3] - dH[3] / 2;
    const Number det_g = gxx * gyy - gxy * gyx, r = 1 / det_g;
    const Number lxx = r * (dH[0] * gyy - dH[1] * gyx), lxy = r * (dH[1] * gxx - dH[0] * gxy);
    const Number lyx = r * (dH[2] * gyy - dH[3] * gyx), lyy = r * (dH[3] * gxx - dH[2] * gxy);
    const Number dzz = hoop_increment(H, dH), tr_d = lxx + lyy + dzz;

    // The rotation by θ, tan(θ/2) = q = w_yx/2; a tensor turns by 2θ in (half difference, shear), by θ under R½.
    const Number q = (lyx - lxy) / 4, over = 1 / (1 + q * q);
    const Number cos = (1 - q * q) * over, sin = 2 * q * over, cos2 = 1 - 2 * sin * sin, sin2 = 2 * sin * cos;
    const double half_n = (s_xx - s_yy) / 2;
    const Number half_d = G_ * (lxx - lyy), shear_d = G_ * (lxy + lyx);
    const Number half = cos2 * half_n - sin2 * s_xy + (cos * half_d - sin * shear_d);
    const Number shear = sin2 * half_n + cos2 * s_xy + (sin * half_d + cos * shear_d);

    // s_zz = s_zz,n + 2 G dev d_zz,  J₂ = half² + shear² + ¾ s_zz²
    const double p_n = (s_xx + s_yy + s_zz) * (1.0 / 3);
    const Number dev_zz = s_zz - p_n + 2 * G_ * (dzz - tr_d * (1.0 / 3));
    const Number root_J2 = sqrt(half * half + shear * shear + 0.75 * (dev_zz * dev_zz) + tiny);

    const Returned<Number> at = returned(p_n, tr_d, root_J2, gap, plastic_strain, dt);
    const Number half_s = at.scale * half, xy = at.scale * shear, dev = at.scale * dev_zz;
    const Number xx = at.p - dev / 2 + half_s, yy = at.p - dev / 2 - half_s, zz = at.p + dev;
    next = {value_of(xx), value_of(yy), value_of(zz), value_of(xy), at.gap, at.plastic_strain};
    return nominal_stress(H, det_g, xx, yy, zz, xy);
  }

  template <class Number>
  Components<Number> in_space(const Components<Number>& H, const Components<Number>& dH, double dt,
                              History& next) const {
    using std::sqrt;
    using T = SpaceTensorOf<Number>;
    const auto [s_xx, s_yy, s_zz, s_xy, s_yz, s_zx, gap, plastic_strain] = next;
    const Number one = 1;
    const T f{1 + H[0], H[1], H[2], H[3], 1 + H[4], H[5], H[6], H[7], 1 + H[8]};
    const T df{dH[0], dH[1], dH[2], dH[3], dH[4], dH[5], dH[6], dH[7], dH[8]};

    // g = f − dH/2,  l = dH g⁻¹ = d + w
    const T g = f - 0.5 * df, cof_g = cofactor(g);
    const Number det_g = g.xx * cof_g.xx + g.xy * cof_g.xy + g.xz * cof_g.xz;
    const T l = (1 / det_g) * (df * transpose(cof_g));
    const Number tr_d = trace(l), third = tr_d * (1.0 / 3);

    // With a the axial vector of w/2 and A x = a × x: R = I + 2/(1 + a²) (A + A²) turns by 2 arctan |a|, and R½ is that
    // of b = a/(1 + √(1 + a²)), which keeps b and turns what is across it: R½ = (1 − c b²) I + c (B + b bᵀ).
    const Number ax = (l.zy - l.yz) / 4, ay = (l.xz - l.zx) / 4, az = (l.yx - l.xy) / 4;
    const Number a2 = ax * ax + ay * ay + az * az, by_half = 1 / (1 + sqrt(1 + a2));
    const Number bx = by_half * ax, by = by_half * ay, bz = by_half * az, b2 = by_half * by_half * a2;
    const Number c = 2 / (1 + b2), across = 1 - c * b2, cx = c * bx, cy = c * by, cz = c * bz;
    const Number c_xy = cx * by, c_yz = cy * bz, c_zx = cz * bx;
    const T R_half{across + cx * bx, c_xy - cz, c_zx + cy, c_xy + cz,       across + cy * by,
                   c_yz - cx,        c_zx - cy, c_yz + cx, across + cz * bz};

    // s = R½ (R½ s_n R½ᵀ + 2 G dev d) R½ᵀ
    const double p_n = (s_xx + s_yy + s_zz) * (1.0 / 3);
    const Number xy_n = s_xy, yz_n = s_yz, zx_n = s_zx;
    const T s_n{s_xx - p_n, xy_n, zx_n, xy_n, s_yy - p_n, yz_n, zx_n, yz_n, s_zz - p_n};
    const Number mean = 2 * G_ * third, xy_d = G_ * (l.xy + l.yx), yz_d = G_ * (l.yz + l.zy), zx_d = G_ * (l.zx + l.xz);
    const T dev_d{2 * G_ * l.xx - mean, xy_d, zx_d, xy_d, 2 * G_ * l.yy - mean, yz_d, zx_d, yz_d, 2 * G_ * l.zz - mean};
    const T s = turned(R_half, turned(R_half, s_n) + dev_d);
    const Number root_J2 =
        sqrt((s.xx * s.xx + s.yy * s.yy + s.zz * s.zz) / 2 + (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx) + tiny);

    const Returned<Number> at = returned(p_n, tr_d, root_J2, gap, plastic_strain, dt);
    const Number xx = at.p + at.scale * s.xx, yy = at.p + at.scale * s.yy, zz = at.p + at.scale * s.zz;
    const Number xy = at.scale * s.xy, yz = at.scale * s.yz, zx = at.scale * s.zx;
    next = {value_of(xx), value_of(yy), value_of(zz), value_of(xy),
            value_of(yz), value_of(zx), at.gap,       at.plastic_strain};

    // P = σ cof f; NaN, through the shear stresses, if f or g is turned inside out
    const T cof_f = cofactor(f);
    const Number det_f = f.xx * cof_f.xx + f.xy * cof_f.xy + f.xz * cof_f.xz;
    const Number good = det_f > 0 && det_g > 0 ? one : Number(std::numeric_limits<double>::quiet_NaN());
    const T P = T{xx, good * xy, good * zx, good * xy, yy, good * yz, good * zx, good * yz, zz} * cof_f;
    return {P.xx, P.xy, P.xz, P.yx, P.yy, P.yz, P.zx, P.zy, P.zz};
  }

  struct ConeAt {
    double eta, k;  // [1], [Pa]
  };
  // The yield coefficients after softening to γᵖ.
  ConeAt cone_at(double plastic_strain) const {
    const double lost = plastic_strain * softening_rate_, share = lost < 1 ? lost : 1;
    return {eta_ + share * eta_change_, k_ + share * k_change_};
  }

  /// The result of the return mapping: σ = p I + scale s_trial, and the updated gap and γᵖ.
  template <class Number>
  struct Returned {
    Number p, scale;
    double gap, plastic_strain;
  };
  // Returns the trial state p_n + K (tr d + gap), √J₂ to the cone or the cut-off.
  template <class Number>
  Returned<Number> returned(double p_n, const Number& tr_d, const Number& root_J2, double gap, double plastic_strain,
                            double dt) const {
    const Number p_trial = p_n + K_ * (tr_d + gap);

    const auto [eta, k] = cone_at(plastic_strain);
    const double apex = k / (eta + tiny), p_cut = tension_ < apex ? tension_ : apex;

    // On the cone Δγ = f/(G + K η η̄ + 1/(β dt)), on its edge with the cut-off f(p_cut)/(G + 1/(β dt))
    const double flow_resistance = fluidity_ > 0 ? G_ + 1 / (fluidity_ * dt) : G_;
    const Number cone = positive(root_J2 + eta * p_trial - k) * (1 / (flow_resistance + K_ * eta * eta_bar_));
    const Number edge = positive(root_J2 + eta * p_cut - k) * (1 / flow_resistance);
    const Number p_cone = p_trial - K_ * eta_bar_ * cone;
    const bool open = p_cone > p_cut;
    const Number dgamma = open ? edge : cone, p = open ? Number(p_cut) : p_cone;
    const Number opened = gap + tr_d + (p_n - p_cut) * (1 / K_) - eta_bar_ * edge;

    // s = (1 − G Δγ/√J₂) s_trial
    const Number over_root_J2 = 1 / root_J2;
    return {p, 1 - G_ * dgamma * over_root_J2, open ? value_of(opened) : 0, plastic_strain + value_of(dgamma)};
  }

  struct ElasticTrial {
    ElasticTrial(const Gradient<S>& H, const History& now)
        : f(deformation_gradient<S>(H)), sigma(stress_tensor<S>(cauchy(now))), J(determinant(f)), tau(J * sigma) {}
    Tensor f, sigma;
    double J;
    Tensor tau;
  };
  auto rate_at(const ElasticTrial& at) const {
    return [this, at](const Tensor& l) {
      const Tensor d = 0.5 * (l + transpose(l)), w = l - d;
      return at.J * (((K_ - 2 * G_ / 3) * trace(d)) * identity<Tensor> + 2 * G_ * d + w * at.sigma - at.sigma * w);
    };
  }
  // Avoids 0/0 at √J₂ = 0 and at φ = 0, where the apex is infinitely far.
  static constexpr double tiny = 1e-300;

  template <class Number>
  static Number positive(const Number& x) {
    return x > 0 ? x : Number(0);
  }

  // The hoop increment d_θθ.
  template <class Number>
  static Number hoop_increment(const Components<Number>& H, const Components<Number>& dH) {
    if constexpr (S == StressState::axisymmetric) {
      return dH[4] / (1 + H[4] - dH[4] / 2);
    } else {
      return 0;
    }
  }

  // P = det(f) σ f⁻ᵀ = σ cof f; NaN, through σ_xy, if f or g is turned inside out.
  template <class Number>
  static Components<Number> nominal_stress(const Components<Number>& H, const Number& det_g, const Number& xx,
                                           const Number& yy, const Number& zz, const Number& xy) {
    const Number nan = std::numeric_limits<double>::quiet_NaN();
    const Number fxx = 1 + H[0], fxy = H[1], fyx = H[2], fyy = 1 + H[3], det_f = fxx * fyy - fxy * fyx;
    if constexpr (S == StressState::axisymmetric) {
      const Number hoop = 1 + H[4], s = det_f > 0 && det_g > 0 && hoop > 0 ? xy : nan;
      return {hoop * (xx * fyy - s * fxy), hoop * (s * fxx - xx * fyx), hoop * (s * fyy - yy * fxy),
              hoop * (yy * fxx - s * fyx), zz * det_f};
    } else {
      const Number s = det_f > 0 && det_g > 0 ? xy : nan;
      return {xx * fyy - s * fxy, s * fxx - xx * fyx, s * fyy - yy * fxy, yy * fxx - s * fyx};
    }
  }

  double K_, G_;                                   // [Pa]
  double eta_, k_, eta_bar_;                       // k = ξ c [Pa], at the peak
  double eta_change_, k_change_, softening_rate_;  // changes from peak to residual values, and their rate per γᵖ
  double fluidity_, tension_;
};

}  // namespace stillpoint
