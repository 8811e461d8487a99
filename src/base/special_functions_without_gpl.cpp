// Special functions by Boost.Math, in long double if that has more digits.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/math/special_functions/lambert_w.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <fmt/format.h>

#include "base/special_functions.hpp"

namespace stillpoint {
namespace {

namespace math = boost::math;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// A policy in which errors give values that are not finite.
using Quiet = math::policies::policy<math::policies::domain_error<math::policies::ignore_error>,
                                     math::policies::pole_error<math::policies::ignore_error>,
                                     math::policies::overflow_error<math::policies::ignore_error>,
                                     math::policies::evaluation_error<math::policies::ignore_error>>;

double finite(double value) { return std::isfinite(value) ? value : no_value; }

}  // namespace

double lambert_w(double x) { return finite(math::lambert_w0(x, Quiet())); }

// Sums 2 Σ x^k/(k + 2)! if the difference would lose digits.
double relative_exponential_2(double x) {
  if (std::abs(x) >= 1) return finite((std::expm1(x) - x) / (x * x / 2));
  constexpr int most = 18;  // 2/20! is below rounding
  double sum = 1, term = 1;
  for (int k = 1; k <= most; ++k) sum += term *= x / (k + 2);
  return sum;
}

double elliptic_f(double phi, double k) { return finite(math::ellint_1(k, phi, Quiet())); }
double elliptic_e(double phi, double k) { return finite(math::ellint_2(k, phi, Quiet())); }
double elliptic_k(double k) { return finite(math::ellint_1(k, Quiet())); }
double bessel_j0(double x) { return finite(math::cyl_bessel_j(0, x, Quiet())); }
double bessel_j1(double x) { return finite(math::cyl_bessel_j(1, x, Quiet())); }
double legendre(int k, double x) { return finite(math::legendre_p(k, x, Quiet())); }

double student_quantile(double probability, double degrees_of_freedom) {
  return quantile(math::students_t_distribution<double, Quiet>(degrees_of_freedom), probability);
}

JacobiFunctions jacobi(double u, double k) {
  double cn = no_value, dn = no_value;
  const double sn = math::jacobi_elliptic(k, u, &cn, &dn, Quiet());
  return {finite(sn), finite(cn)};
}

double zero_between(double a, double b, const std::function<double(double)>& f) {
  const auto value = [&f](double x) {
    const double found = f(x);
    if (!std::isfinite(found)) throw std::domain_error(fmt::format("no zero is found: there is no value at {:g}", x));
    return found;
  };
  const double at_a = f(a), at_b = f(b);
  if (const auto end = zero_at_an_end(a, b, at_a, at_b)) return *end;
  constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();
  const auto near = [](double low, double high) {
    return high - low <= rounding * std::min(std::abs(low), std::abs(high));
  };
  std::uintmax_t steps = 500;  // about ten are enough
  const auto [low, high] = math::tools::toms748_solve(value, a, b, at_a, at_b, near, steps, Quiet());
  return low + (high - low) / 2;
}

}  // namespace stillpoint
