// Gaps between the material and a face of the grid, function by function.
//
// A function that does not vanish on a face reaches a cell into the grid, so that it may move material that does not
// touch the face. Its gap is that of its material nearest to the face,
//
//   g_a = min_p s (x_face − x_p) − d_p,   over the points with N_ap > 0,
//
// s = ±1 outwards, d_p the depth of p below its body's surface: that of a domain by its present corners, otherwise that
// of the initial body. Hence u_a ≤ g_a at all functions of a face lets no material pass it: Σ_a N_a u_a ≤ g at each
// position.
#pragma once

#include <stillpoint/scene_options.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/kernels/point_functions.hpp"
#include "space/points/material_points.hpp"
#include "space/points/point_domains.hpp"
#include "space/points/surface_depths.hpp"

namespace stillpoint {

/// The width of the cells at a face of a grid, along its normal [m].
template <int Dim>
double cell_width(const Grid<Dim>& grid, Face face) {
  const auto& nodes = grid.axes[axis_of(face)].nodes;
  return is_upper(face) ? nodes.back() - nodes[nodes.size() - 2] : nodes[1] - nodes[0];
}

template <int Dim>
class FaceGaps {
 public:
  static constexpr double nothing = std::numeric_limits<double>::infinity();

  /// All arguments belong to the phase that begins, and must outlive this object; ranks: that share the points.
  FaceGaps(const GridFunctions<Dim>& functions, const MaterialPoints<Dim>& points, const PointFunctions<Dim>& weights,
           SurfaceDepths<Dim>& depths, const Ranks* ranks)
      : window_(functions.window()),
        grid_(functions.grid()),
        points_(points),
        weights_(weights),
        depths_(depths),
        ranks_(ranks) {}

  /// The gap of each of these functions of a face, in ascending order [m]; `nothing` if no material reaches the
  /// function, 0 where the gap is not known.
  std::vector<double> of(Face face, const std::vector<int>& functions) const {
    const bool upper = is_upper(face);
    const int axis = axis_of(face);
    const int cells = grid_.axes[axis].cells();
    const double at = position_of(face);
    std::vector<double> gaps(functions.size(), nothing);
    for (std::size_t k = 0; k < points_.cells(); ++k) {
      const int from_face = upper ? cells - 1 - weights_.cell_at(k)[axis] : weights_.cell_at(k)[axis];
      if (from_face >= window_) continue;
      for (std::size_t p = points_.begin(k); p < points_.end(k); ++p) {
        double gap = nothing;
        // A function of the point's cell vanishes at a point only if that lies on a grid line; a domain need not reach
        // into the next cell.
        typename PointFunctions<Dim>::Numbers N;
        if (window_ > 1) weights_.values(k, p, N);
        for (int a = 0; a < weights_.functions_of_cell(); ++a) {
          if (window_ > 1 && std::abs(N[a]) <= rounding) continue;
          const auto found = std::ranges::lower_bound(functions, weights_.function(k, a));
          if (found == functions.end() || *found != weights_.function(k, a)) continue;
          if (gap == nothing) gap = of_point(p, face, at);
          double& least = gaps[static_cast<std::size_t>(found - functions.begin())];
          least = std::min(least, gap);
        }
      }
    }
    if (ranks_) ranks_->smallest(std::span(gaps));
    return gaps;
  }
  /// The least gap of the initial bodies [m], which also counts contact with a face between two points.
  double least_of_bodies(Face face) const {
    double least = nothing;
    for (std::size_t body = 0; body < depths_.bodies(); ++body) least = std::min(least, of_body(body, face));
    return least;
  }
  double of_body(std::size_t body, Face face) const { return depths_.gap(body, face, position_of(face)); }

  double cell_at(Face face) const { return cell_width(grid_, face); }

 private:
  static constexpr double rounding = 1e-12;

  double position_of(Face face) const {
    const Axis& across = grid_.axes[axis_of(face)];
    return is_upper(face) ? across.max() : across.min();
  }
  double of_point(std::size_t p, Face face, double at) const {
    const int axis = axis_of(face);
    const double outward = is_upper(face) ? 1 : -1;
    if (points_.has_domains()) {
      double least = nothing;
      for (const auto& corner : Domain<Dim>::of(points_, p).x) least = std::min(least, outward * (at - corner[axis]));
      return least;
    }
    const auto depth = depths_.along(face, points_.number[p], points_.position(p));
    return depth ? outward * (at - points_.x[axis][p]) - *depth : 0;
  }

  int window_;
  const Grid<Dim>& grid_;
  const MaterialPoints<Dim>& points_;
  const PointFunctions<Dim>& weights_;
  SurfaceDepths<Dim>& depths_;
  const Ranks* ranks_;
};

}  // namespace stillpoint
