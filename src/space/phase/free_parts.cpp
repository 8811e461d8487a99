#include "space/phase/free_parts.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "space/kernels/shared_corners.hpp"

namespace stillpoint {

template <int Dim>
std::vector<CellOfPart> cells_of_parts(const MaterialPoints<Dim>& points, const PointFunctions<Dim>& weights,
                                       const Ranks* ranks) {
  struct Placed {
    CellPlace place;
    CellOfPart cell;
  };
  std::vector<Placed> placed;
  for (std::size_t k = 0; k < points.cells(); ++k)
    placed.push_back({place_of_cell(points, k), {weights.first_function(k), points.number[points.begin(k)]}});
  placed = joined_lists(ranks, std::move(placed));
  if (ranks) std::ranges::stable_sort(placed, {}, &Placed::place);
  std::vector<CellOfPart> cells;
  for (const Placed& one : placed) cells.push_back(one.cell);
  return cells;
}

template <int Dim>
std::vector<FreePart> find_free_parts(const std::vector<CellOfPart>& cells, const PointFunctions<Dim>& weights,
                                      const GridFunctions<Dim>& functions, int first_axis, const DegreesOfFreedom& dofs,
                                      const std::vector<char>& sprung, bool as_one) {
  const int per_cell = functions.per_cell();
  constexpr int nowhere = -1;
  // Functions of one cell belong to one part (a union-find structure): each points to another of its part, the first to
  // itself.
  std::vector<int> next(dofs.number.size() / Dim);
  std::iota(next.begin(), next.end(), 0);
  const auto first_of = [&next](int f) {
    while (next[static_cast<std::size_t>(f)] != f) {
      int& to = next[static_cast<std::size_t>(f)];
      f = to = next[static_cast<std::size_t>(to)];
    }
    return f;
  };
  int last = nowhere;
  for (const CellOfPart& cell : cells) {
    if (!as_one) last = nowhere;
    for (int a = 0; a < per_cell; ++a) {
      const int f = cell.first_function + weights.offset(a);
      dofs.for_sources(Dim * f, [&](int unknown, int, double) {
        const int source = unknown / Dim;
        if (last != nowhere) next[static_cast<std::size_t>(first_of(source))] = first_of(last);
        last = source;
      });
    }
  }

  struct Found {
    FreePart part;
    bool held = false;
  };
  std::map<std::pair<int, int>, Found> all;  // by first function and axis
  std::vector<char> seen(dofs.number.size(), 0);
  for (const CellOfPart& cell : cells) {
    for (int a = 0; a < per_cell; ++a) {
      const int f = cell.first_function + weights.offset(a);
      for (int i = first_axis; i < Dim && functions.is_value(f); ++i) {
        const auto unknown = static_cast<std::size_t>(Dim * f + i);
        const int dof = dofs.number[unknown];
        if (dof < 0 || dofs.is_extended(dof) || std::exchange(seen[unknown], 1)) continue;
        auto [found, is_new] = all.try_emplace({first_of(f), i});
        FreePart& part = found->second.part;
        if (is_new) part.axis = i, part.point = static_cast<std::size_t>(cell.point);
        if (!dofs.is_free(dof) || sprung[unknown]) found->second.held = true;
        part.unknowns.push_back(static_cast<std::size_t>(dof));
      }
    }
  }
  std::vector<FreePart> free;
  for (auto& [key, found] : all) {
    found.part.is_whole = all.begin()->first.first == all.rbegin()->first.first;
    if (!found.held) free.push_back(std::move(found.part));
  }
  return free;
}

template std::vector<CellOfPart> cells_of_parts(const MaterialPoints<1>&, const PointFunctions<1>&, const Ranks*);
template std::vector<FreePart> find_free_parts(const std::vector<CellOfPart>&, const PointFunctions<1>&,
                                               const GridFunctions<1>&, int, const DegreesOfFreedom&,
                                               const std::vector<char>&, bool);
template std::vector<CellOfPart> cells_of_parts(const MaterialPoints<2>&, const PointFunctions<2>&, const Ranks*);
template std::vector<FreePart> find_free_parts(const std::vector<CellOfPart>&, const PointFunctions<2>&,
                                               const GridFunctions<2>&, int, const DegreesOfFreedom&,
                                               const std::vector<char>&, bool);
template std::vector<CellOfPart> cells_of_parts(const MaterialPoints<3>&, const PointFunctions<3>&, const Ranks*);
template std::vector<FreePart> find_free_parts(const std::vector<CellOfPart>&, const PointFunctions<3>&,
                                               const GridFunctions<3>&, int, const DegreesOfFreedom&,
                                               const std::vector<char>&, bool);

}  // namespace stillpoint
