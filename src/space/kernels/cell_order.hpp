// What cells have, in the order that they have in the whole body, whatever ranks they belong to: sums in this order
// have the bits of one process.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/kernels/shared_corners.hpp"

namespace stillpoint {

/// The values of all ranks by the places of their cells, those of a cell in the order in which its rank has them. mine:
/// of this rank, with the place of each in `places`, in ascending order.
template <class T>
std::vector<T> in_cell_order(const Ranks* ranks, const std::vector<CellPlace>& places, std::vector<T> mine) {
  if (!ranks) return mine;
  const std::vector<CellPlace> place = joined_lists(ranks, places);
  const std::vector<T> all = joined_lists(ranks, std::move(mine));
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return place[k]; });
  std::vector<T> sorted;
  sorted.reserve(all.size());
  for (const std::size_t k : order) sorted.push_back(all[k]);
  return sorted;
}

}  // namespace stillpoint
