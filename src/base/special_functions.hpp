// Functions beyond those of <cmath>, by GSL, or by Boost in a build without the libraries under the GPL. Arguments
// outside the stated ranges give NaN.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace stillpoint {

/// Lambert's W_0: the w ≥ −1 with w e^w = x, x ≥ −1/e.
double lambert_w(double x);

/// (e^x − 1 − x)/(x²/2), 1 at 0.
double relative_exponential_2(double x);

/// The elliptic integrals ∫₀^φ of (1 − k² sin²)^(−1/2) and of (1 − k² sin²)^(1/2); 0 ≤ k < 1.
double elliptic_f(double phi, double k);
double elliptic_e(double phi, double k);
/// The complete integral elliptic_f(π/2, k).
double elliptic_k(double k);

/// Jacobi's functions sin φ and cos φ of the φ with elliptic_f(φ, k) = u.
struct JacobiFunctions {
  double sn, cn;
};
JacobiFunctions jacobi(double u, double k);

/// Bessel's functions of the first kind.
double bessel_j0(double x);
double bessel_j1(double x);

/// Legendre's polynomial P_k, |x| ≤ 1.
double legendre(int k, double x);

/// The quantile of Student's distribution with that many degrees of freedom.
double student_quantile(double probability, double degrees_of_freedom);

/// The zero of f between a < b, at whose ends it has different signs, to rounding: the zero stays bracketed (Brent's
/// method, or that of Alefeld, Potra and Shi). Throws std::domain_error if the signs do not differ, or f has no value.
double zero_between(double a, double b, const std::function<double(double)>& f);
/// The check that precedes the search: the end at which f is zero; empty if f changes its sign in between. Throws
/// std::domain_error in all other cases.
inline std::optional<double> zero_at_an_end(double a, double b, double at_a, double at_b) {
  if (at_a == 0) return a;
  if (at_b == 0) return b;
  if (std::isfinite(at_a) && std::isfinite(at_b) && (at_a < 0) != (at_b < 0)) return std::nullopt;
  throw std::domain_error(
      fmt::format("there is no zero to be found between {:g} and {:g}, with values {:g} and {:g}", a, b, at_a, at_b));
}

}  // namespace stillpoint
