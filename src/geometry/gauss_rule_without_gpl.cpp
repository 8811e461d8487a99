// The rule by Boost: positions at the zeros x of P_n, with weights 2/((1 − x²) P_n'(x)²) on [−1, 1], in long double, as
// the slopes P_n' lose digits.
#include <boost/math/special_functions/legendre.hpp>

#include "geometry/gauss_rule.hpp"

namespace stillpoint {

GaussRule::GaussRule(double a, double b, std::size_t n) : at(n), weight(n) {
  const int degree = static_cast<int>(n);
  const auto zeros = boost::math::legendre_p_zeros<long double>(degree);  // the zeros that are not negative
  const long double middle = (a + b) / 2, half = (b - a) / 2;
  for (std::size_t k = 0; k < zeros.size(); ++k) {
    const long double x = zeros[k], slope = boost::math::legendre_p_prime(degree, x);
    const std::size_t above = n - zeros.size() + k, below = n - 1 - above;
    at[above] = static_cast<double>(middle + half * x);
    at[below] = static_cast<double>(middle - half * x);
    weight[above] = weight[below] = static_cast<double>(half * 2 / ((1 - x * x) * slope * slope));
  }
}

}  // namespace stillpoint
