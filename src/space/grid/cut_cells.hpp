// Sliver cells, which a body hardly reaches, and their hosts: cells further inside, whose functions determine theirs.
//
// A function of degree p whose support meets the body only in a sliver of width ε h is (x/h)^p there, so that
//
//   K_i ∝ ε^(2p−1),   M_i ∝ ε^(p+1) lumped, ε^(2p+1) consistent,   ω_i² = K_i/M_i ∝ ε^(p−2) or ε^−2:
//
// with a lumped mass a cubic function becomes arbitrarily slow, in a corner of the plane a quadratic one too, and
// dominates the body's ω₁; linear functions, and all functions with a consistent mass, become arbitrarily fast. Either
// way the functions add nothing to the answer. Hence their coefficients follow from those of a nearby cell that the
// body fills better, the host of the sliver, see sliver_extension.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "space/grid/grid.hpp"

namespace stillpoint {

/// The covered share of each cell, by the cell's number, in ascending order; cells that are not listed are empty.
using CellShares = std::vector<std::pair<int, double>>;

template <int Dim>
class CutCells {
 public:
  /// covered: the shares covered by each part of the body. degree: of the basis.
  CutCells(const Grid<Dim>& grid, const std::vector<CellShares>& covered, int degree)
      : grid_(grid), covered_(covered), enough_(degree < 3 ? 0.25 : 0.5) {
    together_.assign(static_cast<std::size_t>(grid.cells()), 0);
    for (const CellShares& part : covered) {
      for (const auto& [cell, share] : part) together_[static_cast<std::size_t>(cell)] += share;
    }
    for (int c = 0; c < grid.cells(); ++c) {
      if (is_sliver(c)) slivers_.push_back(c);
    }
  }

  /// Whether the body covers enough of a cell for its functions to be unknowns.
  bool has_enough(int cell) const { return share(cell) >= enough_; }
  /// The slivers in ascending order.
  const std::vector<int>& slivers() const { return slivers_; }

  /// The host of a sliver: the nearest of the cells one or two away that is no sliver and for which may_host(sliver,
  /// cell) holds; among equally near ones the cell that has most in common with the sliver's parts of the body. The
  /// sliver itself if there is none.
  template <class MayHost>
  int host_of(int sliver, const MayHost& may_host) const {
    int host = sliver, nearest = std::numeric_limits<int>::max();
    double most = 0;
    const auto at = grid_.cell_at(sliver);
    std::array<int, Dim> offset;
    offset.fill(-reach);
    do {
      int distance = 0;
      for (const int o : offset) distance += o * o;
      const auto candidate = moved(at, offset);
      if (distance == 0 || distance > nearest || !grid_.holds(candidate)) continue;
      const int number = grid_.cell_number(candidate);
      const double common = in_common(sliver, number);
      if (!has_enough(number) || common == 0 || (distance == nearest && common <= most)) continue;
      if (!ends_here(at, offset) || !may_host(sliver, number)) continue;
      host = number;
      nearest = distance;
      most = common;
    } while (next(offset));
    return host;
  }

 private:
  static constexpr int reach = 2;

  double share(int cell) const { return together_[static_cast<std::size_t>(cell)]; }
  bool is_sliver(int cell) const { return share(cell) > 0 && share(cell) < enough_; }
  static std::array<int, Dim> moved(std::array<int, Dim> cell, const std::array<int, Dim>& by) {
    for (int d = 0; d < Dim; ++d) cell[d] += by[d];
    return cell;
  }
  static bool next(std::array<int, Dim>& offset) {
    for (int& o : offset) {
      if (++o <= reach) return true;
      o = -reach;
    }
    return false;
  }

  static double share_of(const CellShares& part, int cell) {
    const auto found = std::ranges::lower_bound(part, cell, {}, &CellShares::value_type::first);
    return found != part.end() && found->first == cell ? found->second : 0;
  }
  double in_common(int a, int b) const {
    double sum = 0;
    for (const CellShares& part : covered_) sum += share_of(part, a) * share_of(part, b);
    return sum;
  }

  // Whether the body ends in the sliver or in slivers behind it, seen from the host; otherwise the sliver is a thin
  // bridge, which has to remain one.
  bool ends_here(const std::array<int, Dim>& sliver, const std::array<int, Dim>& to_host) const {
    for (int d = 0; d < Dim; ++d) {
      if (to_host[d] == 0) continue;
      auto behind = sliver;
      do {
        behind[d] -= to_host[d] > 0 ? 1 : -1;
      } while (grid_.holds(behind) && is_sliver(grid_.cell_number(behind)));
      if (grid_.holds(behind) && share(grid_.cell_number(behind)) > 0) return false;
    }
    return true;
  }

  const Grid<Dim>& grid_;
  const std::vector<CellShares>& covered_;
  double enough_;  // a cell is a sliver if less of it is covered
  std::vector<double> together_;
  std::vector<int> slivers_;
};

}  // namespace stillpoint
