// Loops over the entries of long vectors: vectorised, threaded when long, and the same bits for any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace stillpoint {

/// Below this many entries a thread team costs more than it saves.
inline constexpr std::size_t threaded_from = 1 << 13;

/// body(i) for i = 0 … n−1, in any order.
template <class Body>
inline void for_each_index(std::size_t n, const Body& body) {
  if (n < threaded_from) {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) body(i);
  } else {
#pragma omp parallel
    {
      const Body own(body);  // a thread's copy, that no store can change: the loop is vectorised
#pragma omp for simd schedule(static)
      for (std::size_t i = 0; i < n; ++i) own(i);
    }
  }
}

/// body(k) for k = 0 … n−1, a body that is itself a loop over the points of a cell: threaded from a thousand on.
template <class Body>
inline void for_each_block(std::size_t n, const Body& body) {
  constexpr std::size_t blocks_for_threads = 1024;
#pragma omp parallel for schedule(static) if (n >= blocks_for_threads)
  for (std::size_t k = 0; k < n; ++k) body(k);
}

/// join over term(0) … term(n−1), join associative up to rounding. The order is fixed by n alone: at most 64 blocks,
/// each in 16 lanes, lanes and then blocks joined in order; neither threads nor the compiler's vectors change it.
template <class Value, class Term, class Join>
inline Value reduce(std::size_t n, Value neutral, const Term& term, const Join& join) {
  constexpr std::size_t lanes = 16, most_blocks = 64, shortest_block = 1024;
  const std::size_t share = (n + most_blocks - 1) / most_blocks;
  const std::size_t block = std::max(shortest_block, (share + lanes - 1) / lanes * lanes);
  const std::size_t blocks = (n + block - 1) / block;
  std::array<Value, most_blocks> of_block;

  const auto reduce_block = [&](std::size_t b) {
    std::array<Value, lanes> of_lane;
    of_lane.fill(neutral);
    const std::size_t begin = b * block, end = std::min(n, begin + block);
    const std::size_t whole = begin + (end - begin) / lanes * lanes;
    for (std::size_t i = begin; i < whole; i += lanes) {
#pragma omp simd
      for (std::size_t k = 0; k < lanes; ++k) of_lane[k] = join(of_lane[k], term(i + k));
    }
    for (std::size_t i = whole; i < end; ++i) of_lane[i - whole] = join(of_lane[i - whole], term(i));
    Value all = neutral;
    for (const Value& one : of_lane) all = join(all, one);
    of_block[b] = all;
  };
  if (n < threaded_from) {
    for (std::size_t b = 0; b < blocks; ++b) reduce_block(b);
  } else {
#pragma omp parallel for schedule(static)
    for (std::size_t b = 0; b < blocks; ++b) reduce_block(b);
  }

  Value all = neutral;
  for (std::size_t b = 0; b < blocks; ++b) all = join(all, of_block[b]);
  return all;
}

/// Σ term(i), in the order of reduce().
template <class Term>
inline double sum_over(std::size_t n, const Term& term) {
  return reduce(n, 0.0, term, [](double a, double b) { return a + b; });
}

}  // namespace stillpoint
