// The material points of a cell that a polygon's border cuts.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/polygon.hpp"
#include "geometry/polygon_rule.hpp"

namespace stillpoint {

/// A rule in the coordinates of the part of the cell that lies inside.
struct CutCellRule {
  PlaneRule points;
  int degree = 0;  // every polynomial of this total degree is integrated exactly
};

/// The highest degree tried; no basis here can use more.
inline constexpr int highest_cut_cell_degree = 9;

/// Points that lie inside, with equal shares and the degree that these happen to integrate. inside: not empty.
CutCellRule equal_shares(const Polygon& part, const std::vector<PlanePoint>& inside);

/// The same points, with shares fitted to the moments of the part,
///
///   Σ_p share_p q(x_p) = mean of q over the part,   share_p ≥ 0,
///
/// for all q up to the total degree that the points allow, nearest to equal shares; points whose share vanishes are
/// omitted.
CutCellRule fitted_shares(const Polygon& part, const std::vector<PlanePoint>& inside);

/// Gauss points of the part's trapezoids, of the highest degree that `most` points or fewer can integrate; where the
/// trapezoids have more points than that, (degree + 1)(degree + 2)/2 or fewer of them suffice [Tchakaloff 1957]. most ≥
/// 1.
CutCellRule gauss_points(const Polygon& part, std::size_t most);

}  // namespace stillpoint
