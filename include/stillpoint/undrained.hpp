// Saturated ground from which no water flows: any law with a history for the effective stress σ', and the pore pressure
// p_w of water that is compressed with the pores (positive, as the stress that it causes is −p_w I),
//
//   σ = σ' − p_w I,   p_w = p_0 − (K_w/n) ln J,
//
// with the bulk modulus K_w of water and the porosity n. Grains are incompressible beside it [Wood 2004, Geotechnical
// Modelling, §4.5]. Its change is that of ln det f since the last commit, so that it depends on J alone.
#pragma once

#include <stillpoint/logarithm.hpp>
#include <stillpoint/stress_history.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace stillpoint {

/// What an increment leaves of the water: its share of P and its pressure.
template <StressState S, class Number>
struct WaterAfter {
  GradientOf<S, Number> P;  // [Pa]
  Number pressure;          // [Pa]
};

/// From the committed pressure; stiffness: K_w/n [Pa].
template <StressState S, class Number>
[[gnu::always_inline]] inline WaterAfter<S, Number> water_after(const GradientOf<S, Number>& H,
                                                                const GradientOf<S, Number>& dH, double pressure_before,
                                                                double stiffness) {
  GradientOf<S, Number> before = H;
  unroll<gradient_components(S)>([&](auto c) __attribute__((always_inline)) { before[c] = H[c] - dH[c]; });
  const Number J = volume_ratio<S>(H), J_before = volume_ratio<S>(before);
  const Number growth = logarithm_of(J / J_before, (J - J_before) / J_before);
  const Number pressure = pressure_before - stiffness * growth;
  std::array<Number, stress_components(S)> of_water{};
  unroll<3>([&](auto a) __attribute__((always_inline)) { of_water[a] = -pressure; });
  return {nominal_stress<S, Number>(H, J_before, of_water), pressure};
}

/// A StressHistory in which the history of the law is followed by the pore pressure [Pa].
template <class Law>
class Undrained {
 public:
  static constexpr StressState state = Law::state;
  static constexpr std::size_t history = Law::history + 1;
  using History = std::array<double, history>;
  static constexpr std::array<std::string_view, history> history_names = [] {
    std::array<std::string_view, history> names{};
    std::ranges::copy(Law::history_names, names.begin());
    names.back() = "pore_pressure";
    return names;
  }();
  static constexpr auto place_rows = Law::place_rows;
  static constexpr bool needs_pressure = Law::needs_pressure;

  /// stiffness: K_w/n [Pa].
  Undrained(const Law& law, double stiffness) : law_(law), stiffness_(stiffness) {}

  template <class Number>
  [[gnu::always_inline]] GradientOf<state, Number> first_piola(const GradientOf<state, Number>& H,
                                                               const GradientOf<state, Number>& dH, double dt,
                                                               History& next) const {
    typename Law::History of_skeleton = skeleton(next);
    GradientOf<state, Number> P = law_.first_piola(H, dH, dt, of_skeleton);
    const WaterAfter<state, Number> water = water_after<state, Number>(H, dH, next[Law::history], stiffness_);
    unroll<gradient_components(state)>([&](auto c) __attribute__((always_inline)) { P[c] = P[c] + water.P[c]; });
    unroll<Law::history>([&](auto h) __attribute__((always_inline)) { next[h] = of_skeleton[h]; });
    next[Law::history] = value_of(water.pressure);
    return P;
  }

  /// The total stress.
  [[gnu::always_inline]] static Stress<state> cauchy(const History& now) {
    Stress<state> sigma = Law::cauchy(skeleton(now));
    unroll<3>([&](auto a) __attribute__((always_inline)) { sigma[a] -= now[Law::history]; });
    return sigma;
  }
  /// For ground under this effective stress.
  History initial_history(const Stress<state>& effective, const InitialPoint& point = {}) const {
    History first{};
    std::ranges::copy(law_.initial_history(effective, point), first.begin());
    first[Law::history] = point.pore_pressure;
    return first;
  }
  IsotropicModuli moduli_at(const History& now) const {
    const IsotropicModuli at = law_.moduli_at(skeleton(now));
    return {at.bulk + stiffness_, at.shear};
  }
  bool stress_stays() const { return law_.stress_stays(); }
  bool is_viscous() const { return law_.is_viscous(); }
  YieldState yield_state(const History& now) const { return law_.yield_state(skeleton(now)); }

  Moduli<state> moduli(const Gradient<state>& H, const Gradient<state>& dH, double dt, History now) const {
    return moduli_by_duals(*this, H, dH, dt, now);
  }
  Gradient<state> elastic_rate(const Gradient<state>& H, const Gradient<state>& dH, const History& now) const {
    return elastic(H, now).rate(dH);
  }
  Moduli<state> elastic_moduli(const Gradient<state>& H, const History& now) const { return elastic(H, now).moduli(); }

 private:
  [[gnu::always_inline]] static typename Law::History skeleton(const History& now) {
    typename Law::History of_skeleton;
    unroll<Law::history>([&](auto h) __attribute__((always_inline)) { of_skeleton[h] = now[h]; });
    return of_skeleton;
  }
  ElasticRate<state> elastic(const Gradient<state>& H, const History& now) const {
    const IsotropicModuli at = moduli_at(now);
    return {H, cauchy(now), at.bulk, at.shear};
  }

  Law law_;
  double stiffness_;
};

}  // namespace stillpoint
