// Loops over a few components, written out by the compiler before it looks for vectors: inside a loop over points a
// nested one, however short, can keep it from finding them.
#pragma once

#include <cstddef>
#include <utility>

namespace stillpoint {

/// body(0), …, body(N − 1)
template <int N, class Body>
[[gnu::always_inline]] inline void unroll(const Body& body) {
  [&]<int... c>(std::integer_sequence<int, c...>) __attribute__((always_inline)) {
    (body(std::integral_constant<int, c>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
}

}  // namespace stillpoint
