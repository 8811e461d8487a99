// Explicit Runge–Kutta methods given by their Butcher tables, and the properties that follow from the table alone.
//
//   Y_i = y + h Σ_{j<i} a_ij f(t + c_j h, Y_j),   y⁺ = y + h Σ b_i f(t + c_i h, Y_i)
#pragma once

#include <stillpoint/integrator.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace stillpoint {

struct ButcherTable {
  std::string name;
  int stages = 0, order = 0, embedded_order = 0;
  std::vector<double> A;           // (stages × stages), row by row, strictly lower triangular
  std::vector<double> b, c;        // (stages)
  std::vector<double> b_embedded;  // (stages); empty: no error estimate

  double a(int i, int j) const { return A[static_cast<std::size_t>(i) * b.size() + static_cast<std::size_t>(j)]; }
};

/// Whether the last stage is f(t + h, y⁺), the next step's first: c_s = 1 and the last row of A is b.
bool first_same_as_last(const ButcherTable& table);
/// Evaluations of f that a step costs when implemented well: the stages, less one if first same as last.
int effective_stages(const ButcherTable& table);
/// max |R(h λ)| over the two roots of λ² + rate λ + omega² = 0, with the stability polynomial
/// R(z) = 1 + Σ_k z^k bᵀA^{k−1}1. A call allocates nothing.
AmplificationRadius amplification_of(const ButcherTable& table);

/// The step of an oscillator as the method takes it: each stage evaluates the local damping D at its own v and Q.
OscillatorStep oscillator_step_of(const ButcherTable& table);

/// Kutta's classical method of order 4, without embedding.
ButcherTable classical_rk4();
/// Sofroniou and Spaletta's pair 4(3), five stages, first same as last.
ButcherTable sofroniou_spaletta_5_3_4();
/// Jameson's five stages (1/4, 1/6, 3/8, 1/2, 1), order 2, made for a long imaginary axis.
ButcherTable jameson_5();

}  // namespace stillpoint
