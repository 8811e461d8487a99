// The exponential without a function call, so that a loop over material points that takes one is vectorised.
#pragma once

#include <stillpoint/dual.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace stillpoint {

// eˣ = 2ᵏ (1 + of_r),  x = k ln 2 + r, |r| ≤ ½ ln 2, for −708 < x < 709.
struct ExponentialParts {
  bool fits;
  double two_to_k, of_r;

  [[gnu::always_inline]] explicit ExponentialParts(double x) : fits(x > -708 && x < 709) {
    // Adding 1.5 · 2⁵² rounds to an integer, whose bits are then the last ones of the sum.
    constexpr double to_integer = 6755399441055744.0, per_ln2 = 1.44269504088896338700;
    constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const double inside = fits ? x : 0, shifted = inside * per_ln2 + to_integer, k = shifted - to_integer;
    const double r = (inside - k * ln2_high) - k * ln2_low;
    two_to_k = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1023) << 52);

    // eʳ − 1 = r + r²/2! + … + r¹³/13!, even and odd powers side by side; the rest is below 1e-17 of the sum
    const double z = r * r;
    const double even =
        1.0 / 2 + z * (1.0 / 24 + z * (1.0 / 720 + z * (1.0 / 40320 + z * (1.0 / 3628800 + z * (1.0 / 479001600)))));
    const double odd =
        1.0 / 6 +
        z * (1.0 / 120 + z * (1.0 / 5040 + z * (1.0 / 362880 + z * (1.0 / 39916800 + z * (1.0 / 6227020800)))));
    of_r = r + z * (even + r * odd);
  }
};

/// eˣ; infinite from 709 on, 0 up to −708, NaN for NaN. Error below 1 ulp.
inline double exponential(double x) {
  const ExponentialParts parts(x);
  const double beyond = x > 0 ? std::numeric_limits<double>::infinity() : x < 0 ? 0 : x;
  return parts.fits ? parts.two_to_k + parts.two_to_k * parts.of_r : beyond;
}
/// eˣ − 1 with its digits where x is small: e^1e-20 − 1 = 1e-20. Error below 2 ulp.
inline double exponential_minus_1(double x) {
  const ExponentialParts parts(x);
  const double beyond = x > 0 ? std::numeric_limits<double>::infinity() : x < 0 ? -1 : x;
  return parts.fits ? parts.two_to_k * parts.of_r + (parts.two_to_k - 1) : beyond;
}

/// With derivatives.
template <std::size_t N>
inline Dual<N> exponential(const Dual<N>& x) {
  Dual<N> result(exponential(x.value));
  for (std::size_t k = 0; k < N; ++k) result.derivative[k] = result.value * x.derivative[k];
  return result;
}
template <std::size_t N>
inline Dual<N> exponential_minus_1(const Dual<N>& x) {
  Dual<N> result(exponential_minus_1(x.value));
  for (std::size_t k = 0; k < N; ++k) result.derivative[k] = (1 + result.value) * x.derivative[k];
  return result;
}

}  // namespace stillpoint
