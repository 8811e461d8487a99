// The extension of functions whose support meets the body in slivers alone, from a cell further inside.
//
// In every other cell, the polynomial Σ_k u_k N_k|_c of the functions N_k of the host cell c is a combination Σ_e u_e
// N_e of the functions there. Hence with
//
//   u_e = Σ_k W_ek u_k,   Σ_e W_ek N_e = N_k|_c continued,
//
// the functions N_k + Σ_e W_ek N_e reproduce every polynomial that the basis does, are as smooth as it is, and each of
// them has its share of a cell that the body fills [Höllig, Reif and Wipper 2001, weighted extended B-splines]. W is
// the product of one such matrix along each axis.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "space/grid/basis.hpp"
#include "space/grid/cut_cells.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/grid/extended_functions.hpp"

namespace stillpoint {

/// The basis whose local functions belong to a single cell.
template <AxisBasis B>
struct BasisOfOneCell {
  using type = B;
};
template <int Degree>
struct BasisOfOneCell<DomainBSpline<Degree>> {
  using type = BSpline<Degree>;
};

template <int n>
using SmallMatrix = Eigen::Matrix<double, n, n>;
/// The product A⁻¹ B.
template <int n>
SmallMatrix<n> solved(const SmallMatrix<n>& A, const SmallMatrix<n>& B);

template <AxisBasis B, int Dim>
class SliverExtension {
  using Spline = typename BasisOfOneCell<B>::type;
  using Basis = TensorBasis<Spline, Dim>;
  static constexpr int per_cell = Basis::per_cell;
  using Sources = std::vector<ExtendedFunctions::Source>;

 public:
  /// may_follow(function, sources): whether the function may follow these sources.
  template <class MayFollow>
  SliverExtension(const Grid<Dim>& grid, const CutCells<Dim>& cut, const MayFollow& may_follow)
      : grid_(grid), offset_(Basis::offsets(grid)), functions_(static_cast<std::size_t>(Basis::count(grid))) {
    const auto cells_of = cells_of_outer_functions(cut);
    std::map<int, bool> joined;  // whether all outer functions of each sliver follow others
    for (const auto& [function, cells] : cells_of) {
      const Sources sources = sources_from_nearest_host(function, cells, cut, may_follow);
      if (!sources.empty()) functions_.add(function, sources);
      for (const int cell : cells) joined[cell] = !sources.empty() && joined.try_emplace(cell, true).first->second;
    }
    slivers_ = static_cast<int>(joined.size());
    for (const auto& [cell, is_joined] : joined) joined_ += is_joined ? 1 : 0;
  }

  const ExtendedFunctions& functions() const { return functions_; }
  /// The number of cells with outer functions, which meet the body in slivers alone, and of those in which all of these
  /// follow others.
  int slivers() const { return slivers_; }
  int joined() const { return joined_; }

 private:
  template <class Visit>
  void for_functions(int cell, const Visit& visit) const {
    const int first = Basis::first(grid_, grid_.cell_at(cell));
    for (const int offset : offset_) visit(first + offset);
  }

  // The slivers that each outer function reaches.
  std::map<int, std::vector<int>> cells_of_outer_functions(const CutCells<Dim>& cut) const {
    std::vector<char> is_inner(static_cast<std::size_t>(Basis::count(grid_)), 0);
    for (int cell = 0; cell < grid_.cells(); ++cell) {
      if (cut.has_enough(cell)) for_functions(cell, [&](int f) { is_inner[static_cast<std::size_t>(f)] = 1; });
    }
    std::map<int, std::vector<int>> cells_of;
    for (const int sliver : cut.slivers()) {
      for_functions(sliver, [&](int f) {
        if (!is_inner[static_cast<std::size_t>(f)]) cells_of[f].push_back(sliver);
      });
    }
    return cells_of;
  }

  // The sources of a function; none if one of its slivers has no host, as it may be a bridge that strains by itself.
  template <class MayFollow>
  Sources sources_from_nearest_host(int function, const std::vector<int>& cells, const CutCells<Dim>& cut,
                                    const MayFollow& may_follow) const {
    Sources best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const int cell : cells) {
      Sources sources;
      const int host = cut.host_of(cell, [&](int, int candidate) {
        sources = sources_from(function, cell, candidate);
        return may_follow(function, sources);
      });
      if (host == cell) return {};
      const double distance = distance_of(function, host);
      if (!(distance < nearest)) continue;
      nearest = distance;
      best = sources_from(function, cell, host);
    }
    return best;
  }

  // The squared distance from a function's centre to that of a cell, in cells.
  double distance_of(int function, int cell) const {
    const auto at = grid_.cell_at(cell);
    double sum = 0;
    for (int d = 0; d < Dim; ++d) {
      const auto& nodes = grid_.axes[d].nodes;
      const double left = nodes[static_cast<std::size_t>(at[d])], right = nodes[static_cast<std::size_t>(at[d]) + 1];
      const double x = Spline::centre(grid_.axes[d], Basis::index_along(grid_, function, d));
      const double away = (x - (left + right) / 2) / (right - left);
      sum += away * away;
    }
    return sum;
  }

  // The weights W_ek of function e of a cell, from all functions k of the host.
  Sources sources_from(int function, int cell, int host) const {
    constexpr double rounding = 1e-10;
    const auto at = grid_.cell_at(cell), from = grid_.cell_at(host);
    std::array<std::array<double, Spline::per_cell>, Dim> along;
    for (int d = 0; d < Dim; ++d) {
      const int local = Basis::index_along(grid_, function, d) - Spline::first(at[d]);
      along[d] = row_of(grid_.axes[d], at[d], from[d], local);
    }
    Sources sources;
    const int first = Basis::first(grid_, from);
    for (int a = 0; a < per_cell; ++a) {
      double weight = 1;
      for (int d = 0; d < Dim; ++d) weight *= along[d][static_cast<std::size_t>(Basis::axis_index(a, d))];
      if (std::abs(weight) > rounding) sources.push_back({first + offset_[a], weight});
    }
    return sources;
  }

  // Row `local` of W along an axis, from Σ_e W_ek N_e(x_l) = N_k|_host(x_l) at as many positions x_l of the cell as it
  // has functions.
  static std::array<double, Spline::per_cell> row_of(const Axis& axis, int cell, int host, int local) {
    constexpr int n = Spline::per_cell;
    std::array<double, n> row{};
    if (cell == host) {
      row[static_cast<std::size_t>(local)] = 1;
      return row;
    }
    SmallMatrix<n> here, continued;
    const double left = axis.nodes[static_cast<std::size_t>(cell)];
    const double right = axis.nodes[static_cast<std::size_t>(cell) + 1];
    for (int l = 0; l < n; ++l) {
      std::array<double, n> N, dN;
      const double x = left + (right - left) * (l + 0.5) / n;
      Spline::evaluate(axis, cell, x, N.data(), dN.data());
      for (int a = 0; a < n; ++a) here(l, a) = N[static_cast<std::size_t>(a)];
      Spline::evaluate(axis, host, x, N.data(), dN.data());
      for (int a = 0; a < n; ++a) continued(l, a) = N[static_cast<std::size_t>(a)];
    }
    const SmallMatrix<n> W = solved<n>(here, continued);
    for (int a = 0; a < n; ++a) row[static_cast<std::size_t>(a)] = W(local, a);
    return row;
  }

  const Grid<Dim>& grid_;
  std::array<int, per_cell> offset_;
  ExtendedFunctions functions_;
  int slivers_ = 0, joined_ = 0;
};

}  // namespace stillpoint
