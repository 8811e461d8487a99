// Drucker–Prager plasticity, rate-independent or viscous, with a tension cut-off that opens a gap. Tension is positive.
//   f = √J₂ + η p − ξ c,   p = tr σ/3,   flow by √J₂ + η̄ p:   dᵖ = γ̇ᵖ (s/(2 √J₂) + η̄/3 I)
// The plastic strain γᵖ = ∫ γ̇ᵖ dt is conjugate to √J₂ (s : dᵖ = √J₂ γ̇ᵖ): in simple shear, the plastic part of γ.
// Either f ≤ 0, or γ̇ᵖ = β f if f > 0 [Perzyna 1966], by backward Euler.
// Return mapping: [de Souza Neto, Perić and Owen 2008, §8.3].
//
// Volume. Where the cone would return the trial to a p above p_cut, p is p_cut, and what opens is kept as a gap: a
// volumetric strain that closes before p can fall again, so that loose material does not grow by flying apart and
// coming back. p_cut is at most ξ c/η, the apex. Every volume change goes into one of three,
//   tr d = Δp/K + Δgap + η̄ Δγᵖ,
// so dilatancy takes its room out of an open gap and presses only when that is closed. The edge between cone and
// cut-off is Koiter's, p = p_cut and √J₂ = ξ c − η p_cut; at the apex √J₂ = 0. The cut-off itself is never viscous.
//
// Softening: η and ξ c fall linearly from their peak to their residual values at γᵖ = softening_strain. The strength is
// that of the committed γᵖ, one increment late, so that the return stays closed. By place: each point has factors of c
// and E, which it takes along. A law whose parameters are the same everywhere and always is another type, in which
// what follows from them alone is computed once.
#pragma once

#include <stillpoint/drucker_prager_cone.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/stress_history.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

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

/// The law of a stress state. varies: whether a parameter does, from place to place or by softening. The internal
/// variables are the gap and γᵖ, and then the factors of c and E.
template <StressState S, bool varies = false>
class DruckerPrager : public StressHistory<DruckerPrager<S, varies>, S, varies ? 4 : 2> {
  static constexpr std::size_t internals = varies ? 4 : 2;
  using Base = StressHistory<DruckerPrager<S, varies>, S, internals>;

 public:
  using typename Base::History, typename Base::Internal;
  static constexpr auto history_names = Base::names_of_history({"gap", "plastic_strain"});
  static constexpr auto place_rows = Base::template place_rows_of<varies>({{"c", 2}, {"E", 3}});

  /// Throws std::invalid_argument for parameters that soften, if none varies.
  explicit DruckerPrager(const DruckerPragerParameters& m)
      : elastic_{m.E / (3 * (1 - 2 * m.nu)), m.E / (2 * (1 + m.nu))}, fluidity_(m.fluidity), tension_(m.tension) {
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
    if (!varies && softening_rate_ > 0)
      throw std::invalid_argument("a DruckerPrager law whose parameters do not vary cannot soften");
  }

  template <class Number>
  [[gnu::always_inline]] StressAfter<S, Number, internals> advanced(const GradientOf<S, Number>& H,
                                                                    const GradientOf<S, Number>& dH,
                                                                    const Stress<S>& sigma, const Internal& internal,
                                                                    double dt) const {
    using std::sqrt;
    const auto trial = stress_trial<S, Number>(H, dH, sigma, elasticity(sigma, internal).shear);
    const Number root_J2 = sqrt(second_invariant(trial.s) + tiny);
    const Returned<Number> at = returned(trial.mean, trial.volume_change, root_J2, internal, dt);
    Internal next = internal;
    next[0] = at.gap;
    next[1] = at.plastic_strain;
    return {stress_of(at.p, at.scale * trial.s), next, trial.det_g};
  }
  Internal initial_internal(const Stress<S>&, const InitialPoint&) const {
    Internal first{};
    if constexpr (varies) first[2] = first[3] = 1;
    return first;
  }
  [[gnu::always_inline]] IsotropicModuli elasticity(const Stress<S>&, const Internal& internal) const {
    if constexpr (varies) return {internal[3] * elastic_.bulk, internal[3] * elastic_.shear};
    return elastic_;
  }

  /// Whether a zero increment returns the committed stress: not under softening, as a step takes the strength at its
  /// start, and that at its end is lower.
  bool stress_stays() const { return softening_rate_ == 0; }
  bool is_viscous() const { return fluidity_ > 0; }
  /// The yield state on the cone; the cut-off is never exceeded.
  YieldState yield_state(const History& now) const {
    const Stress<S> sigma = Base::cauchy(now);
    const double p = (sigma[0] + sigma[1] + sigma[2]) / 3;
    const double root_J2 = std::sqrt(second_invariant(deviator_of<S>(sigma, p)));
    const auto [eta, k] = cone_at(Base::internal(now));
    return {.f = root_J2 + eta * p - k, .strength = k - eta * p, .root_J2 = root_J2};
  }

 private:
  struct ConeAt {
    double eta, k;  // [1], [Pa]
  };
  // The yield coefficients after softening to γᵖ.
  [[gnu::always_inline]] ConeAt cone_at(const Internal& internal) const {
    if constexpr (!varies) return {eta_, k_};
    const double lost = internal[1] * softening_rate_, share = lost < 1 ? lost : 1;
    return {eta_ + share * eta_change_, (k_ + share * k_change_) * internal[2]};
  }

  /// The result of the return mapping: σ = p I + scale s_trial, and the updated gap and γᵖ.
  template <class Number>
  struct Returned {
    Number p, scale;
    double gap, plastic_strain;
  };
  // Returns the trial state p_n + K (tr d + gap), √J₂ to the cone or the cut-off.
  template <class Number>
  Returned<Number> returned(double p_n, const Number& tr_d, const Number& root_J2, const Internal& internal,
                            double dt) const {
    const double gap = internal[0], plastic_strain = internal[1];
    const auto [K, G] = elasticity({}, internal);
    const Number p_trial = p_n + K * (tr_d + gap);

    const auto [eta, k] = cone_at(internal);
    const double apex = k / (eta + tiny), p_cut = tension_ < apex ? tension_ : apex;

    // On the cone Δγ = f/(G + K η η̄ + 1/(β dt)), on its edge with the cut-off f(p_cut)/(G + 1/(β dt))
    const double flow_resistance = fluidity_ > 0 ? G + 1 / (fluidity_ * dt) : G;
    const Number cone = positive(root_J2 + eta * p_trial - k) * (1 / (flow_resistance + K * eta * eta_bar_));
    const Number edge = positive(root_J2 + eta * p_cut - k) * (1 / flow_resistance);
    const Number p_cone = p_trial - K * eta_bar_ * cone;
    const bool open = p_cone > p_cut;
    const Number dgamma = open ? edge : cone, p = open ? Number(p_cut) : p_cone;
    const Number opened = gap + tr_d + (p_n - p_cut) * (1 / K) - eta_bar_ * edge;

    // s = (1 − G Δγ/√J₂) s_trial
    const Number over_root_J2 = 1 / root_J2;
    return {p, 1 - G * dgamma * over_root_J2, open ? value_of(opened) : 0, plastic_strain + value_of(dgamma)};
  }

  // Avoids 0/0 at √J₂ = 0 and at φ = 0, where the apex is infinitely far.
  static constexpr double tiny = 1e-300;

  template <class Number>
  static Number positive(const Number& x) {
    return x > 0 ? x : Number(0);
  }

  IsotropicModuli elastic_;
  double eta_, k_, eta_bar_;                       // k = ξ c [Pa], at the peak
  double eta_change_, k_change_, softening_rate_;  // changes from peak to residual values, and their rate per γᵖ
  double fluidity_, tension_;
};

}  // namespace stillpoint
