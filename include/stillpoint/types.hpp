// The few types that every header shares.
#pragma once

#include <cstddef>
#include <span>

namespace stillpoint {

/// A contiguous array of doubles that the callee may write.
using Vec = std::span<double>;
/// A contiguous array of doubles that the callee only reads.
using ConstVec = std::span<const double>;

/// The first half of y = [u; v], or of anything of its shape: (2n) → (n).
template <class T>
std::span<T> first_half(std::span<T> y) {
  return y.first(y.size() / 2);
}
/// The second half of y = [u; v]: (2n) → (n).
template <class T>
std::span<T> second_half(std::span<T> y) {
  return y.last(y.size() / 2);
}

}  // namespace stillpoint
