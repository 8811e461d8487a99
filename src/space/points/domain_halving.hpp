// The halving of domains that are stretched over more than a cell.
//
// A domain takes the functions of the cell of its lower corner and of the next one, so it may be a cell wide, or as
// wide as the narrower of the two. If it were shrunk to that width it would share no corners with its neighbours: Σ_p
// V_p ∇N̄_ip would not telescope there, and a body under tension would yield without limit, or rest on stresses that are
// not in equilibrium. The halves have its velocity and its number, half of its mass, and of its volume the parts that
// they cover.
//
// A neighbour at the edge that is halved may stay whole. In the middle of that edge it takes the mean of the functions
// at the ends, with an error of less than 1/8 of a quadratic function.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "space/points/point_domains.hpp"
#include "space/points/point_order.hpp"

namespace stillpoint {

/// The axis of its own along which domain p has to be halved, or −1. It is decided by the mean sides: a single
/// protruding corner is drawn in where functions are evaluated.
template <int Dim>
int axis_to_halve(const MaterialPoints<Dim>& points, std::size_t p, const Grid<Dim>& grid) {
  constexpr double rounding = 1e-9;
  Point<Dim> ones;
  ones.fill(0.5);
  const auto sides = Domain<Dim>::of(points, p).deformation(ones);  // side j at [Dim i + j]
  Point<Dim> most;
  for (int d = 0; d < Dim; ++d) {
    double width = 0;
    for (int axis = 0; axis < Dim; ++axis) width += std::abs(sides[Dim * d + axis]);
    const double x = points.x[d][p];
    most[d] = widest_between(points, grid.axes[d], d, x - width / 2, x + width / 2);
  }
  const auto share = [&](int d, int axis) { return std::abs(sides[Dim * d + axis]) / most[d]; };
  int along = -1;
  double widest = 1 + rounding;
  for (int d = 0; d < Dim; ++d) {
    double width = 0;
    int longest = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      width += share(d, axis);
      if (share(d, axis) > share(d, longest)) longest = axis;
    }
    if (!(width > widest) || !std::isfinite(width)) continue;
    widest = width;
    along = longest;
  }
  return along;
}

/// Replaces domain p by one half of it.
template <int Dim>
void keep_half(MaterialPoints<Dim>& points, std::size_t p, int axis, bool upper) {
  const auto domain = Domain<Dim>::of(points, p);
  const auto& whole = domain.x;
  for (int d = 0; d < Dim; ++d) {
    for (int c = 0; c < Domain<Dim>::corners; ++c) {
      if (static_cast<bool>(c >> axis & 1) == upper) continue;
      double& corner = points.corner[Dim * c + d][p];
      corner = (whole[c][d] + whole[c ^ (1 << axis)][d]) / 2;
      points.x[d][p] += (corner - whole[c][d]) / Domain<Dim>::corners;
    }
  }
  points.half[axis][p] /= 2;
  points.rest[axis][p] += upper ? points.half[axis][p] : -points.half[axis][p];
  points.volume[p] *= Domain<Dim>::of(points, p).size() / domain.size();
  points.mass[p] /= 2;
}

/// Throws SceneError for a folded domain: under a point force one corner may be drawn out alone, until the rest of the
/// domain is no convex quadrilateral.
template <int Dim>
void refuse_folded_domains(const MaterialPoints<Dim>& points) {
  const auto folded = std::ranges::find_if(points.volume, [](double V) { return !(V > 0); });
  if (folded == points.volume.end()) return;
  const auto p = static_cast<std::size_t>(folded - points.volume.begin());
  throw_scene_error(
      "phase",
      fmt::format("the domain of material point {} at ({:.6g}) is stretched over more than a cell, and folded where it "
                  "would be halved; expected smaller loads or cells, and a [[traction]] where a force acts at a point",
                  points.number[p] + 1, fmt::join(points.position(p), ", ")));
}

/// Halves every domain that is wider than a cell, once. Returns the former number of each point; empty if there is no
/// such domain. The points have to be sorted anew afterwards. A half that is folded has no volume, or a negative one.
template <int Dim>
std::vector<int> halve_wide_domains(MaterialPoints<Dim>& points, const Grid<Dim>& grid) {
  points.widest = widest_domain(grid);
  std::vector<int> axis(points.size());
  for_each_index(axis.size(), [&](std::size_t p) { axis[p] = axis_to_halve(points, p, grid); });
  std::vector<int> from, material_begin;
  for (std::size_t m = 0; m < points.materials(); ++m) {
    material_begin.push_back(static_cast<int>(from.size()));
    for (int p = points.material_begin[m]; p < points.material_begin[m + 1]; ++p) {
      from.push_back(p);
      if (axis[static_cast<std::size_t>(p)] >= 0) from.push_back(p);
    }
  }
  if (from.size() == axis.size()) return {};
  material_begin.push_back(static_cast<int>(from.size()));
  points.material_begin = material_begin;
  take_points(points, from);
  for (std::size_t k = 0; k < from.size(); ++k) {
    const int along = axis[static_cast<std::size_t>(from[k])];
    if (along >= 0) keep_half(points, k, along, k > 0 && from[k] == from[k - 1]);
  }
  return from;
}

}  // namespace stillpoint
