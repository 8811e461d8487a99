// Collects material points while they are placed.
#pragma once

#include <stillpoint/problem.hpp>

#include <numbers>
#include <utility>

#include "space/points/material_points.hpp"

namespace stillpoint {

/// Takes the points of a body in the order of their cells.
template <int Dim>
class PointCollector {
 public:
  PointCollector(double thickness, double density, StressState state)
      : thickness_(thickness), density_(density), axisymmetric_(state == StressState::axisymmetric) {}

  void begin_cell(int number) {
    points_.cell.push_back(number);
    points_.cell_begin.push_back(static_cast<int>(points_.size()));
  }
  /// Adds a point of volume V = area · thickness, or area · 2π r; area: a length in one dimension [m].
  void add(const Point<Dim>& x, double area) {
    add_volume(x, area * (axisymmetric_ ? 2 * std::numbers::pi * x[0] : thickness_));
  }
  void add_volume(const Point<Dim>& x, double volume) {
    for (int d = 0; d < Dim; ++d) points_.x[d].push_back(x[d]);
    points_.volume.push_back(volume);
    points_.mass.push_back(volume * density_);
  }
  /// Adds the domain of the last point: a box around it with half sides r.
  void add_domain(const Point<Dim>& r) {
    for (int d = 0; d < Dim; ++d) {
      const double x = points_.x[d].back();
      points_.half[d].push_back(r[d]);
      points_.rest[d].push_back(x);
      for (int c = 0; c < 1 << Dim; ++c) points_.corner[Dim * c + d].push_back(c >> d & 1 ? x + r[d] : x - r[d]);
    }
  }
  MaterialPoints<Dim> finish() {
    points_.cell_begin.push_back(static_cast<int>(points_.size()));
    return std::move(points_);
  }

 private:
  double thickness_, density_;
  bool axisymmetric_;
  MaterialPoints<Dim> points_;
};

}  // namespace stillpoint
