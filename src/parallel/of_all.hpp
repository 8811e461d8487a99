// What all ranks know of each other: lists, texts, flags and sums. Each function is called by all of them, in the same
// order; ranks: null for a run of one process.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/parallel_loop.hpp"
#include "parallel/ranks.hpp"

namespace stillpoint {

template <class T>
requires(std::is_trivially_copyable_v<T>) Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}
template <class T>
requires(std::is_trivially_copyable_v<T>) void append_from(const Bytes& bytes, std::vector<T>& values) {
  const std::size_t before = values.size();
  values.resize(before + bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data() + before, bytes.data(), bytes.size());
}

/// What each rank has to say, told to all.
inline std::vector<Bytes> told_to_all(const Ranks& ranks, const Bytes& mine) {
  return ranks.deliver(std::vector<Bytes>(static_cast<std::size_t>(ranks.count()), mine));
}

/// The lists of all ranks, one after the other.
template <class T>
requires(std::is_trivially_copyable_v<T>) std::vector<T> joined_lists(const Ranks* ranks, std::vector<T> mine) {
  if (!ranks) return mine;
  std::vector<T> all;
  for (const Bytes& from : told_to_all(*ranks, bytes_of(mine))) append_from(from, all);
  return all;
}
/// What each rank has.
template <class T>
requires(std::is_trivially_copyable_v<T>) std::vector<T> of_all(const Ranks* ranks, const T& mine) {
  return joined_lists(ranks, std::vector<T>{mine});
}
/// The text that comes first, of those that are not empty: by what each rank has its text at, or by their order.
template <class At = int>
std::string first_text(const Ranks* ranks, const std::string& mine, const At& at = {}) {
  if (!ranks) return mine;
  const std::vector<Bytes> texts = told_to_all(*ranks, {mine.begin(), mine.end()});
  const std::vector<At> all = of_all(ranks, at);
  std::size_t first = texts.size();
  for (std::size_t r = 0; r < texts.size(); ++r)
    if (!texts[r].empty() && (first == texts.size() || all[r] < all[first])) first = r;
  return first == texts.size() ? std::string() : std::string(texts[first].begin(), texts[first].end());
}

inline bool is_so_for_all(const Ranks* ranks, bool here) {
  int least = here ? 1 : 0;
  if (ranks) ranks->smallest(std::span(&least, 1));
  return least != 0;
}
inline bool is_so_for_any(const Ranks* ranks, bool here) { return !is_so_for_all(ranks, !here); }

/// The largest value; NaN if one is.
inline double largest_of_all(const Ranks* ranks, double mine) {
  double largest = mine;
  for (const double value : of_all(ranks, mine))
    if (!std::isnan(largest) && !(value <= largest)) largest = value;
  return largest;
}

/// Joins what each rank has of an array whose other entries are 0; of flags, those that some rank has set.
template <class T>
requires(std::is_trivially_copyable_v<T>) void unite(const Ranks* ranks, std::span<T> values) {
  if (ranks) ranks->unite(std::as_writable_bytes(values));
}

/// The sum of term(i) over 0 … n − 1 of each rank, of which neither the order nor the division among ranks is a part.
template <class Term>
double sum_over_ranks(const Ranks* ranks, std::size_t n, const Term& term) {
  const auto alone = [&term](std::size_t /*k*/, std::size_t i) { return term(i); };
  ExactSum all;
  for (const ExactSum& sum : of_all(ranks, exact_sums<1>(1, n, alone)[0])) all.add(sum);
  return all.value();
}

}  // namespace stillpoint
