// Numbers that are computed together, by the vector types that GCC and Clang have: as many as fill a register of the
// processor that this is compiled for. With half of AVX-512's width, eight would take two registers each, and the
// kernels, which need about thirty of them, would measure how fast a processor spills.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

namespace yardsticks {

#if defined(__AVX512F__)
constexpr int lanes = 8, vector_bits = 512;
#elif defined(__AVX__)
constexpr int lanes = 4, vector_bits = 256;
#else
constexpr int lanes = 4, vector_bits = 128;
#endif

constexpr int together = 8;  // the points of a cell in space, or of two cells in the plane
constexpr int groups = together / lanes;

typedef double Lanes __attribute__((vector_size(sizeof(double) * lanes)));  // NOLINT(modernize-use-using)
typedef double Four __attribute__((vector_size(sizeof(double) * 4)));       // NOLINT(modernize-use-using)

template <class Vector>
[[gnu::always_inline]] inline Vector load(const double* from) {
  Vector loaded;
  std::memcpy(&loaded, from, sizeof loaded);
  return loaded;
}
template <class Vector>
[[gnu::always_inline]] inline void store(const Vector& vector, double* to) {
  std::memcpy(to, &vector, sizeof vector);
}

[[gnu::always_inline]] inline Lanes square_root(const Lanes& a) {
  Lanes root;
  for (int l = 0; l < lanes; ++l) root[l] = std::sqrt(a[l]);
  return root;
}
[[gnu::always_inline]] inline Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }
[[gnu::always_inline]] inline Lanes smaller(const Lanes& a, const Lanes& b) { return a < b ? a : b; }

// Numbers a[l] + … summed over the lanes: {Σa, Σb, Σc, 0}.
[[gnu::always_inline]] inline Four sums(const Lanes& a, const Lanes& b, const Lanes& c) {
  const Lanes none{};
#if defined(__AVX512F__)
  const Lanes ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
                   __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes c0 = __builtin_shufflevector(c, none, 0, 8, 2, 10, 4, 12, 6, 14) +
                   __builtin_shufflevector(c, none, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes halves = __builtin_shufflevector(ab, c0, 0, 1, 8, 9, 4, 5, 12, 13) +
                       __builtin_shufflevector(ab, c0, 2, 3, 10, 11, 6, 7, 14, 15);
  return __builtin_shufflevector(halves, halves, 0, 1, 2, 3) + __builtin_shufflevector(halves, halves, 4, 5, 6, 7);
#else
  const Lanes ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes c0 = __builtin_shufflevector(c, none, 0, 4, 2, 6) + __builtin_shufflevector(c, none, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, c0, 0, 1, 4, 5) + __builtin_shufflevector(ab, c0, 2, 3, 6, 7);
#endif
}

}  // namespace yardsticks
