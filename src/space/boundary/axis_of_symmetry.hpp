// The axis of an axisymmetric scene: material at r = 0 stays there, u_r(0) = 0, whatever supports the scene has. The
// strain energy does not enforce this, as a displacement u_r(0) ≠ 0 strains points near the axis by u_r/r, but no point
// lies at r = 0. A body with a hole, however narrow, has no material there and is free.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "scene/body_solid.hpp"
#include "scene/grid_lines.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/points/body.hpp"

namespace stillpoint {

/// The condition u_r = 0 on the axis. It is not a support: no reaction includes its force.
template <Kinematics K>
class AxisOfSymmetry {
  static constexpr int dim = dimensions(K);

 public:
  /// Finds the points that touch the axis in the initial body.
  AxisOfSymmetry(const Problem& problem, const Grid<dim>& grid, const Body<K>& body, double time_scale)
      : rest_(Expression(0.0), time_scale) {
    if constexpr (K == Kinematics::axisymmetric) {
      slack_ = rounding * cell_length_at(problem.grid, 0, problem.grid.min[0]);
      if (grid.axes[0].min() > slack_) return;
      for (std::size_t b = 0; b < problem.bodies.size(); ++b) find_touching(problem.bodies[b], b, body);
    }
  }

  /// Whether a body reaches the axis.
  bool acts() const { return !touches_.empty(); }

  /// Prescribes u_r of the functions that do not vanish on the axis, near material that touched it at first, which
  /// still does, as nothing comes between. reached: as in BoundaryCondition::hold().
  void hold(const GridFunctions<dim>& functions, const MaterialPoints<dim>& points, const PointFunctions<dim>& weights,
            const std::vector<char>& reached, const Ranks* ranks, HeldUnknowns& held) const {
    if (!acts()) return;
    std::vector<char> at_axis(reached.size(), 0);
    for (std::size_t k = 0; k < points.cells(); ++k) {
      if (weights.cell_at(k)[0] != 0 || !any_touches(points, k)) continue;
      for (int a = 0; a < weights.functions_of_cell(); ++a)
        at_axis[static_cast<std::size_t>(weights.function(k, a))] = 1;
    }
    unite(ranks, std::span(at_axis));
    for (const int function : functions.on_face(/*axis=*/0, /*upper=*/false)) {
      const auto f = static_cast<std::size_t>(function);
      if (at_axis[f] && reached[f] && !held.is_prescribed(dim * function))
        held.prescribe(dim * function, rest_, HeldUnknowns::nobody);
    }
  }

 private:
  static constexpr double rounding = 1e-9;  // share of a cell

  void find_touching(const BodySpec& spec, std::size_t b, const Body<K>& body) {
    const std::vector<std::pair<double, double>> along = parts_at_axis(spec);
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      const int number = body.points.number[p];
      if (number < body.first_number[b] || number >= body.first_number[b + 1]) continue;
      const bool touches = spec.shape() == BodyShape::points
                               ? fills_way_to_axis(body.points, p)
                               : std::ranges::any_of(along, [z = body.points.x[1][p]](const auto& part) {
                                   return z >= part.first && z <= part.second;
                                 });
      if (!touches) continue;
      touches_.resize(static_cast<std::size_t>(body.first_number.back()), 0);
      touches_[static_cast<std::size_t>(number)] = 1;
    }
  }

  // The intervals of the axis that the body's outline covers [m].
  std::vector<std::pair<double, double>> parts_at_axis(const BodySpec& spec) const {
    std::vector<std::pair<double, double>> parts;
    if (spec.shape() == BodyShape::points) return parts;
    const Polygon outline = outline_of(spec);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const PlanePoint &a = outline[k], &c = outline[(k + 1) % outline.size()];
      if (std::max(a[0], c[0]) <= slack_) parts.emplace_back(std::min(a[1], c[1]), std::max(a[1], c[1]));
    }
    return parts;
  }

  // Whether a point of a file, taken as a ring of square section and of the point's volume, leaves no room for another
  // point between itself and the axis, nor for a hole that could be told from the gaps of unevenly spaced points.
  static bool fills_way_to_axis(const MaterialPoints<dim>& points, std::size_t p) {
    constexpr double unevenness = 0.25;  // share of the section's side
    const double r = points.x[0][p], side = std::sqrt(points.volume[p] / (2 * std::numbers::pi * r));
    return r <= (0.5 + unevenness) * side;
  }

  bool any_touches(const MaterialPoints<dim>& points, std::size_t k) const {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      if (touches_[static_cast<std::size_t>(points.number[p])]) return true;
    }
    return false;
  }

  PrescribedMotion rest_;
  double slack_ = 0;           // [m]
  std::vector<char> touches_;  // whether a point touches the axis, by its number; empty: none does
};

}  // namespace stillpoint
