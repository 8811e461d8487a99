// Mohr–Coulomb plasticity with a tension cut-off; Tresca's for φ = 0. Tension is positive. The return in principal
// stresses is that of mohr_coulomb_return.hpp, exact on faces, edges, the apex and the cut-off's planes and corners.
//
// Where all three principal stresses reach the cut-off, what opens is kept as a gap, a volumetric strain that closes
// before the stress can fall again, as in Drucker–Prager's law. A crack under one or two principal stresses has no
// memory of its width.
//
// The plastic strain γᵖ = ∫ (d₁ᵖ − d₃ᵖ) dt is, in simple shear, the plastic part of γ.
//
// Softening, or hardening: c cos φ, sin φ and sin ψ are linear between the rows of a table in γᵖ. The strength is that
// of the committed γᵖ, one increment late, so that the return stays closed. By place: each point has factors of c and
// E, which it takes along.
#pragma once

#include <stillpoint/mohr_coulomb_return.hpp>
#include <stillpoint/problem.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace stillpoint {

struct MohrCoulombParameters {
  double E, nu = 0;                // [Pa], [1]
  double c = 0, phi = 0, psi = 0;  // cohesion [Pa], friction and dilatancy [degrees], at γᵖ = 0
  double tension = std::numeric_limits<double>::infinity();  // σ_t [Pa]; above the apex: the apex
  std::vector<StrengthRow> softening{};                      // by γᵖ > 0, which rises from row to row

  static MohrCoulombParameters from(const MaterialSpec& material) {
    const auto value = [&](const char* key) { return material.parameters.at(key); };
    return {.E = value("E"),
            .nu = value("nu"),
            .c = value("c"),
            .phi = value("phi"),
            .psi = value("psi"),
            .tension = value("tension"),
            .softening = material.softening};
  }
};

/// varies: whether the strength changes with plastic strain, or a parameter from place to place. The internal variables
/// are the gap and γᵖ, and then the factors of c and E.
template <StressState S, bool varies = false>
class MohrCoulomb : public StressHistory<MohrCoulomb<S, varies>, S, varies ? 4 : 2> {
  static constexpr std::size_t internals = varies ? 4 : 2;
  using Base = StressHistory<MohrCoulomb<S, varies>, S, internals>;

 public:
  using typename Base::History, typename Base::Internal;
  static constexpr auto history_names = Base::names_of_history({"gap", "plastic_strain"});
  static constexpr auto place_rows = Base::template place_rows_of<varies>({{"c", 2}, {"E", 3}});

  explicit MohrCoulomb(const MohrCoulombParameters& m)
      : elastic_{m.E / (3 * (1 - 2 * m.nu)), m.E / (2 * (1 + m.nu))},
        tension_(m.tension),
        at_first_(shares(m)),
        softens_(!m.softening.empty()) {
    if (m.softening.size() > (varies ? most_strength_rows : 0))
      throw std::invalid_argument("a table of softening has too many rows");
    Shares before = at_first_;
    double begin = 0;
    for (std::size_t k = 0; k < m.softening.size(); ++k) {
      const auto& row = m.softening[k];
      const Shares at = shares(row);
      const double over = 1 / (row.plastic_strain - begin);
      ramps_[k] = {
          begin,
          row.plastic_strain - begin,
          {(at.sin_phi - before.sin_phi) * over, (at.sin_psi - before.sin_psi) * over, (at.k - before.k) * over}};
      before = at;
      begin = row.plastic_strain;
    }
  }

  template <class Number>
  [[gnu::always_inline]] StressAfter<S, Number, internals> advanced(const GradientOf<S, Number>& H,
                                                                    const GradientOf<S, Number>& dH,
                                                                    const Stress<S>& sigma, const Internal& internal,
                                                                    double /*dt*/) const {
    const double gap = internal[0], plastic_strain = internal[1];
    const IsotropicModuli elastic = elasticity(sigma, internal);
    const auto trial = stress_trial<S, Number>(H, dH, sigma, elastic.shear);
    const Number p = trial.mean + elastic.bulk * (trial.volume_change + gap);
    const PrincipalOf<S, Number> axes(trial.s);
    const Principal<Number> s = axes.values(), x{p + s[0], p + s[1], p + s[2]};

    const MohrCoulombStrength strength = strength_at(internal);
    const Principal<Number> y = returned(x, strength, elastic);
    const Number mean = (y[0] + y[1] + y[2]) * (1.0 / 3);
    const bool yields = yield_function(x[0], x[2], strength) > Number(0), opens = x[0] > Number(strength.tension);
    const bool stays = !(yields | opens), is_free = !(value_of(y[2]) < strength.tension), at_vertex = is_free & !stays;
    const double opened = (value_of(p) - strength.tension) / elastic.bulk;
    const double sheared = (value_of(x[0]) - value_of(x[2]) - (value_of(y[0]) - value_of(y[2]))) / (2 * elastic.shear);
    Internal next = internal;
    next[0] = either(at_vertex & (opened > 0), opened, 0.0);
    next[1] = plastic_strain + larger(sheared, 0.0);
    return {stress_of(either(stays, p, mean), either_deviator(stays, trial.s, axes.with(y, mean))), next, trial.det_g};
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
  /// start, and that at its end is another.
  bool stress_stays() const { return !softens_; }
  bool is_viscous() const { return false; }
  /// The yield state on the pyramid, for the direction of the present deviator; the cut-off is never exceeded.
  YieldState yield_state(const History& now) const {
    const Stress<S> sigma = Base::cauchy(now);
    const double p = (sigma[0] + sigma[1] + sigma[2]) / 3;
    const DeviatorOf<S, double> s = deviator_of<S>(sigma, p);
    const Principal<double> of_s = PrincipalOf<S, double>(s).values();
    const MohrCoulombStrength strength = strength_at(Base::internal(now));
    const double root_J2 = std::sqrt(second_invariant(s));
    const double mobilised = of_s[0] * (1 + strength.sin_phi) - of_s[2] * (1 - strength.sin_phi);
    const double available = 2 * (strength.k - p * strength.sin_phi);
    return {.f = (mobilised - available) / 2,
            .strength = mobilised > 0 ? root_J2 * available / mobilised : available / 2,
            .root_J2 = root_J2};
  }

 private:
  struct Shares {
    double sin_phi, sin_psi, k;
  };
  struct Ramp {
    double begin, length;  // in γᵖ
    Shares slopes;
  };

  template <class Row>
  static Shares shares(const Row& row) {
    constexpr double degree = std::numbers::pi / 180;
    return {std::sin(row.phi * degree), std::sin(row.psi * degree), row.c * std::cos(row.phi * degree)};
  }
  [[gnu::always_inline]] MohrCoulombStrength strength_at(const Internal& internal) const {
    Shares at = at_first_;
    if constexpr (varies) {
      const double plastic_strain = internal[1];
      const auto add = [&](const Ramp& ramp) __attribute__((always_inline)) {
        const double beyond = plastic_strain - ramp.begin, from_0 = beyond > 0 ? beyond : 0;
        const double way = from_0 < ramp.length ? from_0 : ramp.length;
        at.sin_phi += way * ramp.slopes.sin_phi;
        at.sin_psi += way * ramp.slopes.sin_psi;
        at.k += way * ramp.slopes.k;
      };
      unroll<most_strength_rows>([&](auto k) __attribute__((always_inline)) { add(ramps_[k]); });
      at.k *= internal[2];
    }
    return MohrCoulombStrength::from(at.sin_phi, at.sin_psi, at.k, tension_);
  }

  template <class Number>
  [[gnu::always_inline]] static PlaneDeviator<Number> either_deviator(bool first, const PlaneDeviator<Number>& a,
                                                                      const PlaneDeviator<Number>& b) {
    return {either(first, a.half, b.half), either(first, a.shear, b.shear), either(first, a.zz, b.zz)};
  }
  template <class Number>
  [[gnu::always_inline]] static SpaceTensorOf<Number> either_deviator(bool first, const SpaceTensorOf<Number>& a,
                                                                      const SpaceTensorOf<Number>& b) {
    const Number xy = either(first, a.xy, b.xy), yz = either(first, a.yz, b.yz), zx = either(first, a.zx, b.zx);
    return {either(first, a.xx, b.xx), xy, zx, xy, either(first, a.yy, b.yy), yz, zx, yz, either(first, a.zz, b.zz)};
  }

  IsotropicModuli elastic_;
  double tension_;
  Shares at_first_;
  bool softens_;
  std::array<Ramp, varies ? most_strength_rows : 0> ramps_{};
};

}  // namespace stillpoint
