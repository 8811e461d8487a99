// Cuts the part of a body's border that a traction acts on into pieces, several in each cell.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "scene/body_border.hpp"
#include "scene/grid_lines.hpp"
#include "space/boundary/face_pieces.hpp"
#include "space/boundary/grid_crossings.hpp"
#include "space/materials/deformation.hpp"

namespace stillpoint {

/// Pieces of a body's end, of a straight part of its border or, in space, of a part of a face or a curved surface. The
/// area is undeformed, 2 π r ds if axisymmetric [m²].
template <Kinematics K>
class TractionCutter {
  static constexpr int dim = dimensions(K);

 public:
  TractionCutter(const Problem& problem, const TractionSpec& traction, const Grid<dim>& grid)
      : problem_(problem), traction_(traction), grid_(grid) {}

  /// Calls visit(x, area, outward normal, number of the body) for each piece.
  template <class Visit>
  void cut(const Visit& visit) const {
    if constexpr (dim == 1) {
      const BodySpec& body = problem_.bodies.front();
      const bool upper = is_upper(traction_.face.value());
      visit(Point<dim>{(upper ? body.max : body.min)[0]}, body.area, Point<dim>{upper ? 1.0 : -1.0}, std::size_t{0});
    } else if constexpr (dim == 2) {
      for (const BorderLine& line : border_lines(problem_, traction_)) cut_line(line, visit);
    } else if (traction_.surface) {
      cut_surface(visit);
    } else {
      cut_face(visit);
    }
  }

 private:
  std::vector<FacePoint> rule_along(const BodySpec& body, std::size_t along) const {
    const bool carried = problem_.phase.ends();
    const bool varies = std::ranges::any_of(traction_.formulas(), &Expression::uses_position);
    return varies ? varying_face_rule(body, along, carried)
                  : face_rule(body, along, carried, problem_.phase.quadrature == Quadrature::domains);
  }
  template <class Visit>
  void cut_face(const Visit& visit) const {
    const BodySpec& body = problem_.bodies.front();
    const Face face = traction_.face.value();
    const auto normal = static_cast<std::size_t>(axis_of(face));
    Point<dim> outwards{};
    outwards[normal] = is_upper(face) ? 1 : -1;
    for_face_pieces<dim>(
        grid_, normal, (is_upper(face) ? body.max : body.min)[normal],
        part_of_face(face, traction_.from, traction_.to, body.min, body.max),
        [&](std::size_t along) { return rule_along(body, along); },
        [&](const Point<dim>& x, double area, double) { visit(x, area, outwards, std::size_t{0}); });
  }
  // Cuts a surface into pieces of half of the smallest cell, not at the borders of cells: a function with a kink there
  // is integrated to second order.
  template <class Visit>
  void cut_surface(const Visit& visit) const {
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t d = 0; d < dim; ++d) length = std::min(length, smallest_cell(problem_.grid, d) / 2);
    const std::size_t number = body_with_surface(problem_).value();
    const BodySpec& body = problem_.bodies[number];
    for (const SurfacePiece& piece : surface_pieces(body, *traction_.surface, length)) {
      const auto& [x, y, z] = piece.vector;
      const double area = std::hypot(x, y, z);
      visit(piece.x, area, Point<dim>{x / area, y / area, z / area}, number);
    }
  }
  // Cuts a line into the parts in each cell, and these into pieces.
  template <class Visit>
  void cut_line(const BorderLine& line, const Visit& visit) const {
    const BodySpec& body = problem_.bodies[line.body];
    const std::size_t across = std::abs(line.normal[0]) > std::abs(line.normal[1]) ? 0 : 1;
    const std::vector<FacePoint> rule = rule_along(body, 1 - across);
    const std::vector<Point<dim>> ends = grid_crossings(line, grid_);
    for (std::size_t c = 0; c + 1 < ends.size(); ++c) {
      const Point<dim>&from = ends[c], &to = ends[c + 1];
      const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
      for (const auto& [xi, weight] : rule) {
        Point<dim> x;
        for (std::size_t d = 0; d < dim; ++d) x[d] = (from[d] + to[d]) / 2 + (to[d] - from[d]) / 2 * xi;
        const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : body.area;
        visit(x, length / 2 * weight * depth, line.normal, line.body);
      }
    }
  }

  const Problem& problem_;
  const TractionSpec& traction_;
  const Grid<dim>& grid_;
};

}  // namespace stillpoint
