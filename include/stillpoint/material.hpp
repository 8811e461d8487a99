// The interface between material laws and the loops over material points.
//
// A law is a value type in a header of its own, inlined into a loop over points that the compiler vectorises: it has no
// branch that differs from point to point (write a select, "a ? x : y" of computed values), no call that is not
// inlined, no allocation. A trial that cannot be evaluated (det f ≤ 0) gives NaN.
#pragma once

#include <stillpoint/scene_options.hpp>

#include <array>
#include <concepts>
#include <string_view>

namespace stillpoint {

/// The components of a displacement gradient; the conditions across them are left to the law.
enum class Kinematics { line, plane, axisymmetric, space };

constexpr Kinematics kinematics(StressState state) {
  switch (state) {
    case StressState::uniaxial_stress:
    case StressState::uniaxial_strain:
      return Kinematics::line;
    case StressState::axisymmetric:
      return Kinematics::axisymmetric;
    case StressState::space:
      return Kinematics::space;
    default:
      return Kinematics::plane;
  }
}
constexpr int dimensions(Kinematics k) { return k == Kinematics::line ? 1 : k == Kinematics::space ? 3 : 2; }
constexpr int dimensions(StressState state) { return dimensions(kinematics(state)); }
/// Number of components of a displacement gradient H, and of the first Piola–Kirchhoff stress: in one dimension (xx);
/// in the plane (xx, xy, yx, yy), H_ij = ∂u_i/∂x_j; axisymmetric (rr, rz, zr, zz, θθ) with H_θθ = u_r/r; in space (xx,
/// xy, xz, yx, …, zz).
constexpr int gradient_components(Kinematics k) {
  return dimensions(k) * dimensions(k) + (k == Kinematics::axisymmetric ? 1 : 0);
}
constexpr int gradient_components(StressState state) { return gradient_components(kinematics(state)); }
/// Number of components of a Cauchy stress: in one dimension (xx); in two (xx, yy, zz, xy), axisymmetric (rr, zz, θθ,
/// rz); in space (xx, yy, zz, xy, yz, zx).
constexpr int stress_components(Kinematics k) { return k == Kinematics::line ? 1 : k == Kinematics::space ? 6 : 4; }
constexpr int stress_components(StressState state) { return stress_components(kinematics(state)); }

template <StressState S>
using Gradient = std::array<double, gradient_components(S)>;
template <StressState S>
using Stress = std::array<double, stress_components(S)>;
/// Tangent moduli, ∂P_a/∂H_b at [components · a + b].
template <StressState S>
using Moduli = std::array<double, gradient_components(S) * gradient_components(S)>;

struct LameParameters {
  double lambda, mu;  // [Pa]

  // λ = E ν/((1 + ν)(1 − 2ν)),  μ = E/(2 (1 + ν))
  static LameParameters from(double E, double nu) { return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))}; }
};

/// A law whose stress is a function of the deformation alone. H = F − I from the undeformed state.
template <class L>
concept ElasticLaw = requires(const L law, const Gradient<L::state>& H) {
  { L::state } -> std::convertible_to<StressState>;
  { L::finite_strain } -> std::convertible_to<bool>;
  { law.first_piola(H) } -> std::same_as<Gradient<L::state>>;  // P = det(F) σ F⁻ᵀ [Pa]
  { law.cauchy(H) } -> std::same_as<Stress<L::state>>;         // σ [Pa]
  { law.moduli(H) } -> std::same_as<Moduli<L::state>>;         // ∂P/∂H [Pa]
};

/// The relation of a committed stress to the material's long-term strength.
struct YieldState {
  double f = 0;         // the yield function [Pa]; far above 0 for a viscous law alone
  double strength = 0;  // the √J₂ at which f = 0 under this mean stress [Pa]
  double root_J2 = 0;   // [Pa]
};

/// How a point of ground came to the stress that it begins with.
struct InitialPoint {
  /// Under its own weight, sides at rest, σ_yy being vertical: overconsolidation is a ratio of vertical stresses.
  bool at_rest = false;
  double consolidation = 1, void_ratio = 1;  // what OCR or pc, and e0, are here, over the law's numbers
  double pore_pressure = 0;                  // of water at rest [Pa]
};

/// A law with a history of `history` numbers a point, among them its stress. H = ∂u/∂x since the phase began (f = I +
/// H), dH the part of it since the history was committed, dt the time since then [s], ≥ 0.
template <class L>
concept HistoryLaw = requires(const L law, const Gradient<L::state>& H, double dt, typename L::History& next) {
  { L::state } -> std::convertible_to<StressState>;
  requires std::same_as<typename L::History, std::array<double, L::history>>;
  { L::history_names } -> std::convertible_to<std::array<std::string_view, L::history>>;  // for output; "" is not shown
  // P = det(f) σ f⁻ᵀ after the increment; next: the committed history, which is advanced
  { law.first_piola(H, H, dt, next) } -> std::same_as<Gradient<L::state>>;
  { law.cauchy(next) } -> std::same_as<Stress<L::state>>;
  // Whether a zero increment returns the committed stress, to rounding
  { law.stress_stays() } -> std::same_as<bool>;
  // Whether the stress may exceed the strength for a while, as long as the material flows; and by how much it does
  { law.is_viscous() } -> std::same_as<bool>;
  { law.yield_state(next) } -> std::same_as<YieldState>;
  // ∂P/∂H of first_piola() if H and dH change alike; then that of an elastic trial, which is symmetric and at least as
  // stiff, and its product with one δH
  { law.moduli(H, H, dt, next) } -> std::same_as<Moduli<L::state>>;
  { law.elastic_moduli(H, next) } -> std::same_as<Moduli<L::state>>;
  { law.elastic_rate(H, H, next) } -> std::same_as<Gradient<L::state>>;
  // For a point under this stress
  { law.initial_history(law.cauchy(next), InitialPoint{}) } -> std::same_as<typename L::History>;
  { L::needs_pressure } -> std::convertible_to<bool>;  // the stiffness follows the stress: none without a pressure
};

template <class L>
concept MaterialLaw = ElasticLaw<L> || HistoryLaw<L>;

}  // namespace stillpoint
