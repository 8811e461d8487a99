#include "space/grid/sliver_extension.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace stillpoint {
namespace {

// Row `local` of W along an axis, from Σ_e W_ek N_e(x_l) = N_k|_host(x_l) at as many positions x_l of the cell as it
// has functions.
template <AxisBasis Spline>
std::array<double, Spline::per_cell> row_of(const Axis& axis, int cell, int host, int local) {
  constexpr int n = Spline::per_cell;
  std::array<double, n> row{};
  if (cell == host) {
    row[static_cast<std::size_t>(local)] = 1;
    return row;
  }
  Eigen::Matrix<double, n, n> here, continued;
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
  const Eigen::Matrix<double, n, n> W = here.partialPivLu().solve(continued);
  for (int a = 0; a < n; ++a) row[static_cast<std::size_t>(a)] = W(local, a);
  return row;
}

}  // namespace

template <AxisBasis Spline, int Dim>
SliverExtension<Spline, Dim>::SliverExtension(const Grid<Dim>& grid, const CutCells<Dim>& cut,
                                              const MayFollow& may_follow)
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

template <AxisBasis Spline, int Dim>
template <class Visit>
void SliverExtension<Spline, Dim>::for_functions(int cell, const Visit& visit) const {
  const int first = Basis::first(grid_, grid_.cell_at(cell));
  for (const int offset : offset_) visit(first + offset);
}

// The slivers that each outer function reaches.
template <AxisBasis Spline, int Dim>
std::map<int, std::vector<int>> SliverExtension<Spline, Dim>::cells_of_outer_functions(const CutCells<Dim>& cut) const {
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
template <AxisBasis Spline, int Dim>
auto SliverExtension<Spline, Dim>::sources_from_nearest_host(int function, const std::vector<int>& cells,
                                                             const CutCells<Dim>& cut,
                                                             const MayFollow& may_follow) const -> Sources {
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
template <AxisBasis Spline, int Dim>
double SliverExtension<Spline, Dim>::distance_of(int function, int cell) const {
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
template <AxisBasis Spline, int Dim>
auto SliverExtension<Spline, Dim>::sources_from(int function, int cell, int host) const -> Sources {
  constexpr double rounding = 1e-10;
  const auto at = grid_.cell_at(cell), from = grid_.cell_at(host);
  std::array<std::array<double, Spline::per_cell>, Dim> along;
  for (int d = 0; d < Dim; ++d) {
    const int local = Basis::index_along(grid_, function, d) - Spline::first(at[d]);
    along[d] = row_of<Spline>(grid_.axes[d], at[d], from[d], local);
  }
  Sources sources;
  const int first = Basis::first(grid_, from);
  for (int a = 0; a < Basis::per_cell; ++a) {
    double weight = 1;
    for (int d = 0; d < Dim; ++d) weight *= along[d][static_cast<std::size_t>(Basis::axis_index(a, d))];
    if (std::abs(weight) > rounding) sources.push_back({first + offset_[a], weight});
  }
  return sources;
}

template class SliverExtension<BSpline<1>, 1>;
template class SliverExtension<BSpline<2>, 1>;
template class SliverExtension<BSpline<3>, 1>;
template class SliverExtension<CubicHermite, 1>;
template class SliverExtension<BSpline<1>, 2>;
template class SliverExtension<BSpline<2>, 2>;
template class SliverExtension<BSpline<3>, 2>;
template class SliverExtension<CubicHermite, 2>;
template class SliverExtension<BSpline<1>, 3>;
template class SliverExtension<BSpline<2>, 3>;
template class SliverExtension<BSpline<3>, 3>;
template class SliverExtension<CubicHermite, 3>;

}  // namespace stillpoint
