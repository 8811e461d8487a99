// A few doubles that are computed together, in one register of the processor; eight of them in two registers if it has
// none as wide.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
  typedef double Type __attribute__((vector_size(32)));        // NOLINT(modernize-use-using)
  typedef std::int64_t Mask __attribute__((vector_size(32)));  // NOLINT(modernize-use-using)
  static constexpr Mask number{0, 1, 2, 3};
};

template <>
struct LaneRegister<8> {
  typedef double Type __attribute__((vector_size(64)));        // NOLINT(modernize-use-using)
  typedef std::int64_t Mask __attribute__((vector_size(64)));  // NOLINT(modernize-use-using)
  static constexpr Mask number{0, 1, 2, 3, 4, 5, 6, 7};
};

template <int N>
struct Lanes {
  using Register = typename LaneRegister<N>::Type;
  Register lanes;

  [[gnu::always_inline]] static Lanes load(const double* from) {
    Lanes loaded;
    std::memcpy(&loaded.lanes, from, sizeof loaded.lanes);
    return loaded;
  }
  /// Loads the first `count` entries, which are all that may be read, and zeros into the other lanes.
  [[gnu::always_inline]] static Lanes load_first(const double* from, std::size_t count) {
    if (count >= N) return load(from);
    Lanes loaded{};
    for (std::size_t k = 0; k < count; ++k) loaded.lanes[k] = from[k];
    return loaded;
  }
  [[gnu::always_inline]] void store(double* to) const { std::memcpy(to, &lanes, sizeof lanes); }
  [[gnu::always_inline]] void store_first(double* to, std::size_t count) const {
    if (count >= N) return store(to);
    for (std::size_t k = 0; k < count; ++k) to[k] = lanes[k];
  }
  /// Adds factor · x, lane by lane.
  [[gnu::always_inline]] void add(double factor, const Lanes& x) { lanes += factor * x.lanes; }
  [[gnu::always_inline]] Lanes plus(const Lanes& x) const { return {lanes + x.lanes}; }
  [[gnu::always_inline]] Lanes plus(double x) const { return {lanes + x}; }
  [[gnu::always_inline]] Lanes minus(const Lanes& x) const { return {lanes - x.lanes}; }
  [[gnu::always_inline]] Lanes times(double factor) const { return {factor * lanes}; }
  [[gnu::always_inline]] Lanes times(const Lanes& x) const { return {lanes * x.lanes}; }
  [[gnu::always_inline]] Lanes over(double divisor) const { return {lanes / divisor}; }
  [[gnu::always_inline]] Lanes over(const Lanes& x) const { return {lanes / x.lanes}; }
  [[gnu::always_inline]] Lanes plus_product(const Lanes& x, const Lanes& y) const {
    return {lanes + x.lanes * y.lanes};
  }
  [[gnu::always_inline]] Lanes root() const {
    Lanes roots;
    for (int k = 0; k < N; ++k) roots.lanes[k] = std::sqrt(lanes[k]);
    return roots;
  }
  /// The first `count` lanes, and zeros in the others whatever those hold.
  [[gnu::always_inline]] Lanes first(std::size_t count) const {
    const typename LaneRegister<N>::Type zero{};
    return {LaneRegister<N>::number < static_cast<std::int64_t>(count) ? lanes : zero};
  }
  [[gnu::always_inline]] double operator[](int k) const { return lanes[k]; }
};

/// Three numbers, and any other. The array may end with them if is_last, so that the number before them is read.
template <bool is_last>
[[gnu::always_inline]] inline Lanes<4> three_components(const double* from) {
  if constexpr (!is_last) return Lanes<4>::load(from);
  const auto shifted = Lanes<4>::load(from - 1);
  return {__builtin_shufflevector(shifted.lanes, shifted.lanes, 1, 2, 3, 3)};
}

/// The lanes of a, then those of b.
template <int N>
[[gnu::always_inline]] inline Lanes<2 * N> joined(const Lanes<N>& a, const Lanes<N>& b) {
  static_assert(N <= 4);
  if constexpr (N == 1) {
    return {__builtin_shufflevector(a.lanes, b.lanes, 0, 1)};
  } else if constexpr (N == 4) {
    return {__builtin_shufflevector(a.lanes, b.lanes, 0, 1, 2, 3, 4, 5, 6, 7)};
  } else {
    return {__builtin_shufflevector(a.lanes, b.lanes, 0, 1, 2, 3)};
  }
}

[[gnu::always_inline]] inline Lanes<2> lower_half(const Lanes<4>& a) {
  return {__builtin_shufflevector(a.lanes, a.lanes, 0, 1)};
}
[[gnu::always_inline]] inline Lanes<2> upper_half(const Lanes<4>& a) {
  return {__builtin_shufflevector(a.lanes, a.lanes, 2, 3)};
}
[[gnu::always_inline]] inline Lanes<4> lower_half(const Lanes<8>& a) {
  return {__builtin_shufflevector(a.lanes, a.lanes, 0, 1, 2, 3)};
}
[[gnu::always_inline]] inline Lanes<4> upper_half(const Lanes<8>& a) {
  return {__builtin_shufflevector(a.lanes, a.lanes, 4, 5, 6, 7)};
}
[[gnu::always_inline]] inline Lanes<4> halves_added(const Lanes<8>& a) { return lower_half(a).plus(upper_half(a)); }
[[gnu::always_inline]] inline Lanes<4> halves_swapped(const Lanes<4>& a) {
  return {__builtin_shufflevector(a.lanes, a.lanes, 2, 3, 0, 1)};
}

/// The transpose: lane k of each row in the k-th result.
[[gnu::always_inline]] inline std::array<Lanes<4>, 4> transposed(const std::array<Lanes<4>, 4>& rows) {
  const auto ab_even = __builtin_shufflevector(rows[0].lanes, rows[1].lanes, 0, 4, 2, 6);  // a0, b0, a2, b2
  const auto ab_odd = __builtin_shufflevector(rows[0].lanes, rows[1].lanes, 1, 5, 3, 7);
  const auto cd_even = __builtin_shufflevector(rows[2].lanes, rows[3].lanes, 0, 4, 2, 6);
  const auto cd_odd = __builtin_shufflevector(rows[2].lanes, rows[3].lanes, 1, 5, 3, 7);
  return {{{__builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5)},
           {__builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5)},
           {__builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7)},
           {__builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7)}}};
}

/// The sums over the lanes of a, of b, of c and of d.
[[gnu::always_inline]] inline Lanes<4> sums(const Lanes<4>& a, const Lanes<4>& b, const Lanes<4>& c,
                                            const Lanes<4>& d) {
  const auto ab = __builtin_shufflevector(a.lanes, b.lanes, 0, 4, 2, 6) +
                  __builtin_shufflevector(a.lanes, b.lanes, 1, 5, 3, 7);  // a01, b01, a23, b23
  const auto cd =
      __builtin_shufflevector(c.lanes, d.lanes, 0, 4, 2, 6) + __builtin_shufflevector(c.lanes, d.lanes, 1, 5, 3, 7);
  return {__builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7)};
}

/// The sums over the lanes of a, of b and of c, and 0.
[[gnu::always_inline]] inline Lanes<4> sums(const Lanes<8>& a, const Lanes<8>& b, const Lanes<8>& c) {
  return sums(halves_added(a), halves_added(b), halves_added(c), Lanes<4>{});
}

}  // namespace stillpoint
