// Loops over the entries of long vectors: vectorised, threaded when long, and the same bits for any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/thread_team.hpp"

namespace stillpoint {

/// The number of entries below which a thread team costs more than it saves.
inline constexpr std::size_t threaded_from = 1 << 13;

/// Calls body(i) for i = 0 … n−1, in any order.
template <class Body>
inline void for_each_index(std::size_t n, const Body& body) {
  const auto loop = [&body](std::size_t begin, std::size_t end) {
    const Body own(body);  // a copy of the thread's own, which no store can change, so that the loop is vectorised
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i) own(i);
  };
  if (n < threaded_from) {
    loop(0, n);
  } else {
    in_aligned_parts(n, 1, loop);
  }
}

/// Calls body(begin, count) for pieces that divide 0 … n−1, in any order: for several loops, including
/// for_each_index(), over as much as the caches nearest to a core hold.
template <class Body>
inline void for_each_piece(std::size_t n, const Body& body) {
  constexpr std::size_t piece = 2048;
  static_assert(piece < threaded_from);  // one thread each
  const auto loop = [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += piece) body(first, std::min(piece, end - first));
  };
  if (n < threaded_from) {
    loop(0, n);
  } else {
    in_aligned_parts(n, 1, loop);
  }
}

/// Calls body(k) for k = 0 … n−1, a body that is itself a loop over the points of a cell: threaded from a thousand on.
template <class Body>
inline void for_each_block(std::size_t n, const Body& body) {
  constexpr std::size_t blocks_for_threads = 1024;
  const auto loop = [&body](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) body(k);
  };
  if (n < blocks_for_threads) {
    loop(0, n);
  } else {
    in_parts(n, 4, loop);
  }
}

/// For each k < count ≤ most: joins term(k, 0) … term(k, n−1), join associative up to rounding. All k are done in one
/// pass over memory, in pieces that the first-level cache holds. The order is fixed by n alone: at most 64 blocks, each
/// in 16 lanes, lanes and then blocks joined in order; neither threads, the compiler's vectors nor other k change it.
template <std::size_t most, class Value, class Term, class Join>
inline std::array<Value, most> reduce_each(std::size_t count, std::size_t n, Value neutral, const Term& term,
                                           const Join& join) {
  constexpr std::size_t lanes = 16, most_blocks = 64, shortest_block = 1024, piece = 512;
  const std::size_t share = (n + most_blocks - 1) / most_blocks;
  const std::size_t block = std::max(shortest_block, (share + lanes - 1) / lanes * lanes);
  const std::size_t blocks = (n + block - 1) / block;
  std::array<std::array<Value, most>, most_blocks> of_block;

  const auto reduce_block = [&](std::size_t b) {
    std::array<std::array<Value, lanes>, most> all_lanes;
    for (auto& lanes_of_k : all_lanes) lanes_of_k.fill(neutral);
    const std::size_t end = std::min(n, (b + 1) * block);
    for (std::size_t begin = b * block; begin < end; begin += piece) {
      const std::size_t piece_end = std::min(end, begin + piece);
      const std::size_t whole = begin + (piece_end - begin) / lanes * lanes;
      for (std::size_t k = 0; k < count; ++k) {
        std::array<Value, lanes> of_lane = all_lanes[k];
        for (std::size_t i = begin; i < whole; i += lanes) {
#pragma omp simd
          for (std::size_t lane = 0; lane < lanes; ++lane) of_lane[lane] = join(of_lane[lane], term(k, i + lane));
        }
        for (std::size_t i = whole; i < piece_end; ++i) of_lane[i - whole] = join(of_lane[i - whole], term(k, i));
        all_lanes[k] = of_lane;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      Value all = neutral;
      for (const Value& one : all_lanes[k]) all = join(all, one);
      of_block[b][k] = all;
    }
  };
  const auto reduce_entries = [&](std::size_t begin, std::size_t end) {  // in blocks that begin there
    for (std::size_t b = (begin + block - 1) / block; b * block < end; ++b) reduce_block(b);
  };
  if (n < threaded_from) {
    reduce_entries(0, n);
  } else {
    in_aligned_parts(n, 1, reduce_entries);
  }

  std::array<Value, most> result;
  result.fill(neutral);
  for (std::size_t b = 0; b < blocks; ++b) {
    for (std::size_t k = 0; k < count; ++k) result[k] = join(result[k], of_block[b][k]);
  }
  return result;
}

/// Joins term(0) … term(n−1), in the order of reduce_each().
template <class Value, class Term, class Join>
inline Value reduce(std::size_t n, Value neutral, const Term& term, const Join& join) {
  const auto alone = [&term](std::size_t /*k*/, std::size_t i) { return term(i); };
  return reduce_each<1>(1, n, neutral, alone, join)[0];
}

/// The sum Σ term(i), in the order of reduce_each().
template <class Term>
inline double sum_over(std::size_t n, const Term& term) {
  return reduce(n, 0.0, term, [](double a, double b) { return a + b; });
}

}  // namespace stillpoint
