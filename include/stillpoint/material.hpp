// What the loops over material points need of a material law.
#pragma once

#include <stillpoint/scene.hpp>

#include <array>
#include <concepts>

namespace stillpoint {

/// T_ij at [Dim i + j].
template <int Dim>
using Tensor = std::array<double, static_cast<std::size_t>(Dim* Dim)>;
/// ∂P_ij/∂F_kl at [Dim² (Dim i + j) + Dim k + l].
template <int Dim>
using Moduli = std::array<double, static_cast<std::size_t>(Dim* Dim* Dim* Dim)>;

constexpr int dimensions(StressState) { return 1; }

struct LameParameters {
  double lambda, mu;  // [Pa]

  // λ = E ν/((1 + ν)(1 − 2ν)),  μ = E/(2 (1 + ν))
  static LameParameters from(double E, double nu) { return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))}; }
};

/// A value type, inlined into the loops. H = ∂u/∂x since the phase began; a trial that cannot be evaluated gives NaN.
template <class L>
concept MaterialLaw = requires(const L law, const Tensor<L::dim>& H) {
  { L::dim } -> std::convertible_to<int>;
  { L::history_dependent } -> std::convertible_to<bool>;
  { L::finite_strain } -> std::convertible_to<bool>;
  { law.first_piola(H) } -> std::same_as<Tensor<L::dim>>;  // P = det(f) σ f⁻ᵀ [Pa]
  { law.cauchy(H) } -> std::same_as<Tensor<L::dim>>;       // σ [Pa]
  { law.moduli(H) } -> std::same_as<Moduli<L::dim>>;       // ∂P/∂H [Pa]
};

}  // namespace stillpoint
