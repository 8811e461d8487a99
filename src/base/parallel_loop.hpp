// Loops over the entries of long vectors: vectorised, threaded when long, and the same bits for any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>

#include "base/exact_sum.hpp"
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

/// For each k < count ≤ most: term(k, 0) + … + term(k, n−1), so that neither threads nor other k change it. All are
/// done in one pass over memory, in pieces that the first-level cache holds.
template <std::size_t most, class Term>
inline std::array<ExactSum, most> exact_sums(std::size_t count, std::size_t n, const Term& term) {
  std::array<ExactSum, most> sums;
  const auto add_entries = [count, &term](std::size_t begin, std::size_t end, std::array<ExactSum, most>& to) {
    constexpr std::size_t piece = 512;
    for (std::size_t first = begin; first < end; first += piece) {
      const std::size_t last = std::min(end, first + piece);
      for (std::size_t k = 0; k < count; ++k) to[k].add(first, last, [&term, k](std::size_t i) { return term(k, i); });
    }
  };
  if (n < threaded_from) {
    add_entries(0, n, sums);
  } else {
    std::mutex joining;
    in_aligned_parts(n, 1, [&](std::size_t begin, std::size_t end) {
      std::array<ExactSum, most> of_part;
      add_entries(begin, end, of_part);
      const std::lock_guard lock(joining);
      for (std::size_t k = 0; k < count; ++k) sums[k].add(of_part[k]);
    });
  }
  return sums;
}

/// The values of these sums, each rounded once.
template <std::size_t most, class Term>
inline std::array<double, most> sum_each(std::size_t count, std::size_t n, const Term& term) {
  const std::array<ExactSum, most> sums = exact_sums<most>(count, n, term);
  std::array<double, most> values{};
  for (std::size_t k = 0; k < count; ++k) values[k] = sums[k].value();
  return values;
}

/// The sum Σ term(i), of which the order is no part: see ExactSum.
template <class Term>
inline double sum_over(std::size_t n, const Term& term) {
  const auto alone = [&term](std::size_t /*k*/, std::size_t i) { return term(i); };
  return sum_each<1>(1, n, alone)[0];
}

/// Joins term(0) … term(n−1) by a join that has no order, as the larger of two.
template <class Value, class Term, class Join>
inline Value reduce(std::size_t n, Value neutral, const Term& term, const Join& join) {
  constexpr std::size_t lanes = 16;
  Value all = neutral;
  std::mutex joining;
  const auto join_entries = [&](std::size_t begin, std::size_t end) {
    std::array<Value, lanes> of_lane;
    of_lane.fill(neutral);
    const std::size_t whole = begin + (end - begin) / lanes * lanes;
    for (std::size_t i = begin; i < whole; i += lanes) {
#pragma omp simd
      for (std::size_t lane = 0; lane < lanes; ++lane) of_lane[lane] = join(of_lane[lane], term(i + lane));
    }
    for (std::size_t i = whole; i < end; ++i) of_lane[i - whole] = join(of_lane[i - whole], term(i));
    const std::lock_guard lock(joining);
    for (const Value& one : of_lane) all = join(all, one);
  };
  if (n < threaded_from) {
    join_entries(0, n);
  } else {
    in_aligned_parts(n, 1, join_entries);
  }
  return all;
}

}  // namespace stillpoint
