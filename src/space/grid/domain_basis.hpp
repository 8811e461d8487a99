// A spline basis for material points that represent domains, see point_domains.hpp.
#pragma once

#include "space/grid/basis.hpp"

namespace stillpoint {

/// A B-spline basis in which the local functions of `cell` are those of that cell and of the next one, which a domain
/// no wider than a cell may reach.
template <int Degree>
struct DomainBSpline : BSpline<Degree> {
  using Spline = BSpline<Degree>;
  static constexpr int window = 2;
  static constexpr int per_cell = Degree + 2;

  /// x: in one of these cells; on the line between them, or beyond it by a rounding error, it counts as in the first.
  static void evaluate(const Axis& axis, int cell, double x, double* N, double* dN) {
    constexpr double rounding = 1e-12;  // share of a cell: within that distance of the line no further function acts
    const auto line = [&](int k) { return axis.nodes[static_cast<std::size_t>(k)]; };
    const bool second = cell + 1 < axis.cells() && x - line(cell + 1) > rounding * (line(cell + 1) - line(cell));
    N[second ? 0 : per_cell - 1] = dN[second ? 0 : per_cell - 1] = 0;
    Spline::evaluate(axis, second ? cell + 1 : cell, x, N + (second ? 1 : 0), dN + (second ? 1 : 0));
  }
};

}  // namespace stillpoint
