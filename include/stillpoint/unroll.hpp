// Loops over a few components that the compiler unrolls before it vectorises: inside a loop over points a nested loop,
// however short, can prevent vectorisation.
#pragma once

#include <cstddef>
#include <utility>

namespace stillpoint {

/// Calls body(0), …, body(N − 1).
template <int N, class Body>
[[gnu::always_inline]] inline void unroll(const Body& body) {
  [&]<int... c>(std::integer_sequence<int, c...>) __attribute__((always_inline)) {
    (body(std::integral_constant<int, c>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
}

}  // namespace stillpoint
