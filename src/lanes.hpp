// A few doubles that are computed together, in one register of the processor.
#pragma once

#include <cstddef>
#include <cstring>

namespace stillpoint {

/// The compiler's vector types (GCC and Clang).
template <int N>
struct LaneRegister;
template <>
struct LaneRegister<1> {
  typedef double Type __attribute__((vector_size(8)));  // NOLINT(modernize-use-using)
};
template <>
struct LaneRegister<2> {
  typedef double Type __attribute__((vector_size(16)));  // NOLINT(modernize-use-using)
};
template <>
struct LaneRegister<4> {
  typedef double Type __attribute__((vector_size(32)));  // NOLINT(modernize-use-using)
};

template <int N>
struct Lanes {
  typename LaneRegister<N>::Type lanes;

  [[gnu::always_inline]] static Lanes load(const double* from) {
    Lanes loaded;
    std::memcpy(&loaded.lanes, from, sizeof loaded.lanes);
    return loaded;
  }
  /// this + factor · x, lane by lane.
  [[gnu::always_inline]] void add(double factor, const Lanes& x) { lanes += factor * x.lanes; }
  [[gnu::always_inline]] Lanes minus(const Lanes& x) const { return {lanes - x.lanes}; }
  [[gnu::always_inline]] double operator[](int k) const { return lanes[k]; }
};

/// The lanes of a, then those of b.
template <int N>
[[gnu::always_inline]] inline Lanes<2 * N> joined(const Lanes<N>& a, const Lanes<N>& b) {
  static_assert(N <= 2);
  if constexpr (N == 1) {
    return {__builtin_shufflevector(a.lanes, b.lanes, 0, 1)};
  } else {
    return {__builtin_shufflevector(a.lanes, b.lanes, 0, 1, 2, 3)};
  }
}

}  // namespace stillpoint
