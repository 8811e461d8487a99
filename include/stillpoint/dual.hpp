// Forward-mode automatic differentiation: a number with its derivatives by N variables, propagated exactly,
//   (a + Σ a_k ε_k) (b + Σ b_k ε_k) = a b + Σ (a_k b + a b_k) ε_k,   ε_j ε_k = 0     [Griewank and Walther 2008, §3.1].
// A formula written for any number type gives its derivative when it is evaluated with Duals. A comparison compares
// values, so that at a kink the derivative is that of the branch taken.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace stillpoint {

template <std::size_t N>
struct Dual {
  double value = 0;
  std::array<double, N> derivative{};

  constexpr Dual() = default;
  constexpr Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): a constant is a number
  constexpr Dual(double v, const std::array<double, N>& d) : value(v), derivative(d) {}

  friend constexpr Dual operator-(const Dual& a) { return a.chain(-a.value, -1); }
  friend constexpr Dual operator+(const Dual& a, const Dual& b) { return chain(a.value + b.value, 1, a, 1, b); }
  friend constexpr Dual operator-(const Dual& a, const Dual& b) { return chain(a.value - b.value, 1, a, -1, b); }
  friend constexpr Dual operator*(const Dual& a, const Dual& b) {
    return chain(a.value * b.value, b.value, a, a.value, b);
  }
  friend constexpr Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return chain(quotient, 1 / b.value, a, -quotient / b.value, b);
  }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
  friend constexpr bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend constexpr bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }

 private:
  // The chain rule for a function of one argument, df = f_a da, or of two, df = f_a da + f_b db.
  constexpr Dual chain(double f, double f_a) const {
    Dual result(f);
    for (std::size_t k = 0; k < N; ++k) result.derivative[k] = f_a * derivative[k];
    return result;
  }
  static constexpr Dual chain(double f, double f_a, const Dual& a, double f_b, const Dual& b) {
    Dual result(f);
    for (std::size_t k = 0; k < N; ++k) result.derivative[k] = f_a * a.derivative[k] + f_b * b.derivative[k];
    return result;
  }
};

/// A number with its derivative along one direction. As it is two numbers and no array, and all of it is inlined, a
/// loop over points is vectorised with it.
struct Directional {
  double value = 0, rate = 0;

  constexpr Directional() = default;
  constexpr Directional(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): as above
  constexpr Directional(double v, double dv) : value(v), rate(dv) {}

  [[gnu::always_inline]] friend constexpr Directional operator+(const Directional& a, const Directional& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  [[gnu::always_inline]] friend constexpr Directional operator-(const Directional& a, const Directional& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  [[gnu::always_inline]] friend constexpr Directional operator*(const Directional& a, const Directional& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
  [[gnu::always_inline]] friend constexpr Directional operator/(const Directional& a, const Directional& b) {
    const double inverse = 1 / b.value, quotient = a.value * inverse;
    return {quotient, (a.rate - quotient * b.rate) * inverse};
  }
  [[gnu::always_inline]] friend Directional sqrt(const Directional& a) {
    const double root = std::sqrt(a.value);
    return {root, 0.5 * a.rate / root};
  }
};

constexpr double value_of(double x) { return x; }
constexpr double value_of(const Directional& x) { return x.value; }
template <std::size_t N>
constexpr double value_of(const Dual<N>& x) {
  return x.value;
}

/// Independent variables with the values x: ∂x_a/∂x_b = δ_ab.
template <std::size_t N>
constexpr std::array<Dual<N>, N> variables(const std::array<double, N>& x) {
  std::array<Dual<N>, N> all;
  for (std::size_t a = 0; a < N; ++a) {
    all[a].value = x[a];
    all[a].derivative[a] = 1;
  }
  return all;
}

}  // namespace stillpoint
