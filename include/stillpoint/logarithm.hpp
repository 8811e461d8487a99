// The natural logarithm without a function call, so that a loop over material points that takes one is vectorised.
// Method and constants: fdlibm's e_log.c [Sun Microsystems 1993], error below 1 ulp.
#pragma once

#include <stillpoint/dual.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace stillpoint {

/// ln x for x = 1 + x_minus_1, where x_minus_1 has more digits than x keeps of it: ln(1 + 1e-20) = 1e-20. NaN if x is
/// not positive and finite, or below the smallest normal number.
inline double logarithm(double x, double x_minus_1) {
  // x = 2ᵏ m, √½ ≤ m < √2: subtracting the bits of √½ leaves k + 1023 in the exponent field
  constexpr std::uint64_t sqrt_half = 0x3FE6A09E667F3BCD, one = 0x3FF0000000000000, mantissa = 0x000FFFFFFFFFFFFF;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + (one - sqrt_half);
  const double m = std::bit_cast<double>((bits & mantissa) + sqrt_half);
  // converts the integer n < 2⁵²: the mantissa bits of 2⁵² set to n represent 2⁵² + n
  const double k = std::bit_cast<double>((bits >> 52) | 0x4330000000000000) - (4503599627370496.0 + 1023);

  // ln m = ln(1 + f) = f − f²/2 + s (f²/2 + R(s²)),  s = f/(2 + f)
  const double f = x_minus_1 > -0.25 && x_minus_1 < 0.25 ? x_minus_1 : m - 1, s = f / (2 + f), z = s * s,
               half_square = 0.5 * f * f;
  const double R = z * (6.666666666666735130e-01 +
                        z * (3.999999999940941908e-01 +
                             z * (2.857142874366239149e-01 +
                                  z * (2.222219843214978396e-01 +
                                       z * (1.818357216161805012e-01 +
                                            z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  const double ln = k * ln2_high - ((half_square - (s * (half_square + R) + k * ln2_low)) - f);
  using Limits = std::numeric_limits<double>;
  return x >= Limits::min() && x <= Limits::max() ? ln : Limits::quiet_NaN();
}
inline double logarithm(double x) { return logarithm(x, x - 1); }

/// ln x with its derivatives.
template <std::size_t N>
inline Dual<N> logarithm_of(const Dual<N>& x, const Dual<N>& x_minus_1) {
  Dual<N> result(logarithm(x.value, x_minus_1.value));
  for (std::size_t k = 0; k < N; ++k) result.derivative[k] = x.derivative[k] / x.value;
  return result;
}
inline double logarithm_of(double x, double x_minus_1) { return logarithm(x, x_minus_1); }

}  // namespace stillpoint
