// The check that precedes the search for a zero, by the values at the ends of an interval.
#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace stillpoint {

/// The end at which f is zero; empty if f changes its sign in between. Throws std::domain_error in all other cases.
inline std::optional<double> zero_at_an_end(double a, double b, double at_a, double at_b) {
  if (at_a == 0) return a;
  if (at_b == 0) return b;
  if (std::isfinite(at_a) && std::isfinite(at_b) && (at_a < 0) != (at_b < 0)) return std::nullopt;
  throw std::domain_error(
      fmt::format("there is no zero to be found between {:g} and {:g}, with values {:g} and {:g}", a, b, at_a, at_b));
}

}  // namespace stillpoint
