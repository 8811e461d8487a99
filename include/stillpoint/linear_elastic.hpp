// Linear elasticity at small strain: σ = λ tr(ε) I + 2 μ ε, P = σ.
#pragma once

#include <stillpoint/material.hpp>

namespace stillpoint {

template <StressState State>
class LinearElastic {
 public:
  static constexpr int dim = dimensions(State);
  static constexpr bool history_dependent = false;
  static constexpr bool finite_strain = false;

  explicit LinearElastic(const LameParameters& m) requires(dim == 1)
      : stiffness_{State == StressState::uniaxial_stress ? m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu)  // E
                                                         : m.lambda + 2 * m.mu} {}

  // σ_xx = E ε_xx where the section is free to contract, (λ + 2μ) ε_xx where it is not
  Tensor<dim> first_piola(const Tensor<dim>& H) const { return {stiffness_[0] * H[0]}; }
  Tensor<dim> cauchy(const Tensor<dim>& H) const { return first_piola(H); }
  Moduli<dim> moduli(const Tensor<dim>&) const { return stiffness_; }

 private:
  Moduli<dim> stiffness_;  // [Pa]
};

}  // namespace stillpoint
