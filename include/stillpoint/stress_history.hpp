// What laws have in common whose history is the Cauchy stress and a few internal variables, and whose elastic part is
// isotropic: the order of the history, the tangents, the elastic rate.
#pragma once

#include <stillpoint/dual.hpp>
#include <stillpoint/stress_increment.hpp>
#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace stillpoint {

struct IsotropicModuli {
  double bulk, shear;  // K, G [Pa]
};

/// The consistent tangent [Simo and Taylor 1985]: the derivative of first_piola() to rounding, H and dH changing alike.
/// It is symmetric only without stress and plastic flow: a flow that is not associated makes it unsymmetric, and the
/// elastic rate is one of σ and not of τ, which leaves a term of the size of σ/K.
template <class Law>
Moduli<Law::state> moduli_by_duals(const Law& law, const Gradient<Law::state>& H, const Gradient<Law::state>& dH,
                                   double dt, typename Law::History now) {
  constexpr std::size_t n = gradient_components(Law::state);
  const auto P = law.first_piola(variables(H), variables(dH), dt, now);
  Moduli<Law::state> A;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) A[n * a + b] = P[a].derivative[b];
  }
  return A;
}

/// A row of the history that holds what a parameter is at the point, over the number that the law was made with; it
/// never changes.
struct PlaceRow {
  std::string_view parameter;
  std::size_t row;
};

/// What an increment leaves. internal: a law's internal variables, plain values.
template <StressState S, class Number, std::size_t internals>
struct StressAfter {
  std::array<Number, stress_components(S)> stress;
  std::array<double, internals> internal;
  Number det_g;  // of the StressTrial
};

/// Base class of such a law, which has history_names, made by names_of_history(), and
///
///     StressAfter advanced(H, dH, stress, internal, dt) const, a template of the number type, double or a Dual,
///     Internal initial_internal(stress, InitialPoint) const,
///     IsotropicModuli elasticity(stress, internal) const.
template <class Law, StressState S, std::size_t internals>
class StressHistory {
  static_assert(S == StressState::plane_strain || S == StressState::axisymmetric || S == StressState::space,
                "the other states are not written");

 public:
  static constexpr StressState state = S;
  static constexpr std::size_t stresses = stress_components(S);
  static constexpr std::size_t history = stresses + internals;
  /// The parameters that vary from place to place.
  static constexpr std::array<PlaceRow, 0> place_rows{};
  /// Whether the stiffness follows the stress, and is none without a pressure.
  static constexpr bool needs_pressure = false;
  using History = std::array<double, history>;  // σ_xx, σ_yy, σ_zz, σ_xy, in space σ_yz, σ_zx [Pa]; internal variables
  using Internal = std::array<double, internals>;
  static constexpr std::array<std::string_view, history> names_of_history(
      const std::array<std::string_view, internals>& internal_names) {
    std::array<std::string_view, history> names{};
    for (std::size_t k = 0; k < internals; ++k) names[stresses + k] = internal_names[k];
    return names;
  }

  /// place_rows of a law of which internal variables hold them, by their numbers; without any unless the law varies.
  template <bool varies, std::size_t n>
  static constexpr std::array<PlaceRow, varies ? n : 0> place_rows_of(const PlaceRow (&of_internals)[n]) {
    std::array<PlaceRow, varies ? n : 0> rows{};
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = {of_internals[k].parameter, stresses + of_internals[k].row};
    return rows;
  }

  /// P at the end of the increment.
  template <class Number>
  [[gnu::always_inline]] GradientOf<S, Number> first_piola(const GradientOf<S, Number>& H,
                                                           const GradientOf<S, Number>& dH, double dt,
                                                           History& next) const {
    const StressAfter<S, Number, internals> after =
        law().template advanced<Number>(H, dH, cauchy(next), internal(next), dt);
    unroll<stresses>([&](auto a) __attribute__((always_inline)) { next[a] = value_of(after.stress[a]); });
    unroll<internals>([&](auto k) __attribute__((always_inline)) { next[stresses + k] = after.internal[k]; });
    return nominal_stress<S, Number>(H, after.det_g, after.stress);
  }

  [[gnu::always_inline]] static Stress<S> cauchy(const History& now) {
    Stress<S> sigma;
    unroll<stresses>([&](auto a) __attribute__((always_inline)) { sigma[a] = now[a]; });
    return sigma;
  }
  History initial_history(const Stress<S>& sigma, const InitialPoint& point = {}) const {
    const Internal of_law = law().initial_internal(sigma, point);
    History first;
    for (std::size_t a = 0; a < stresses; ++a) first[a] = sigma[a];
    for (std::size_t k = 0; k < internals; ++k) first[stresses + k] = of_law[k];
    return first;
  }

  Moduli<S> moduli(const Gradient<S>& H, const Gradient<S>& dH, double dt, const History& now) const {
    return moduli_by_duals(*this, H, dH, dt, now);
  }
  Gradient<S> elastic_rate(const Gradient<S>& H, const Gradient<S>& dH, const History& now) const {
    return elastic(H, now).rate(dH);
  }
  Moduli<S> elastic_moduli(const Gradient<S>& H, const History& now) const { return elastic(H, now).moduli(); }
  IsotropicModuli moduli_at(const History& now) const { return law().elasticity(cauchy(now), internal(now)); }

 protected:
  [[gnu::always_inline]] static Internal internal(const History& now) {
    Internal of_law;
    unroll<internals>([&](auto k) __attribute__((always_inline)) { of_law[k] = now[stresses + k]; });
    return of_law;
  }

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
  ElasticRate<S> elastic(const Gradient<S>& H, const History& now) const {
    const IsotropicModuli at = moduli_at(now);
    return {H, cauchy(now), at.bulk, at.shear};
  }
};

}  // namespace stillpoint
