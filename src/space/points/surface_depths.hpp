// The initial depths of material points below the surface of their body, stored for points that come near a face of the
// grid.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "scene/body_depth.hpp"
#include "scene/grid_lines.hpp"
#include "space/grid/grid.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

template <int Dim>
class SurfaceDepths {
 public:
  /// first_number: the number of the first point of each body, and the number of all points; origin: positions at the
  /// start of the run, by number, (P × Dim), or empty if points do not move on. All must outlive this object.
  SurfaceDepths(const Problem& problem, const std::vector<int>& first_number, const std::vector<double>& origin)
      : problem_(problem), first_number_(first_number), origin_(origin) {
    for (const BodySpec& body : problem_.bodies) bodies_.emplace_back(body);
  }

  /// The initial depth of the point with this number, along the normal of a face of the grid [m], or two of the longest
  /// cells if it is deeper. Empty if the surface of its body is not known. x: its position, which is the initial one if
  /// there is no origin.
  std::optional<double> along(Face face, int number, const Point<Dim>& x) {
    auto& known = known_[static_cast<std::size_t>(face)];
    const auto [found, is_new] = known.try_emplace(number);
    if (!is_new) return found->second;
    Point<Dim> X = x;
    if (!origin_.empty()) std::copy_n(origin_.begin() + static_cast<std::ptrdiff_t>(Dim) * number, Dim, X.begin());
    const auto axis = static_cast<std::size_t>(axis_of(face));
    found->second =
        bodies_[body_of(first_number_, number)].along(X, axis, is_upper(face), 2 * longest_cell(problem_.grid, axis));
    return found->second;
  }

  std::size_t bodies() const { return problem_.bodies.size(); }
  /// The initial gap between a body and a face of the grid at this coordinate [m]; 0 if it is not known.
  double gap(std::size_t body, Face face, double at) const {
    if (!bodies_[body].is_known()) return 0;
    const auto axis = static_cast<std::size_t>(axis_of(face));
    return is_upper(face) ? at - problem_.bodies[body].max[axis] : problem_.bodies[body].min[axis] - at;
  }

 private:
  const Problem& problem_;
  const std::vector<int>& first_number_;
  const std::vector<double>& origin_;
  std::vector<BodyDepth> bodies_;
  std::array<std::unordered_map<int, std::optional<double>>, static_cast<std::size_t>(2 * Dim)> known_;
};

}  // namespace stillpoint
