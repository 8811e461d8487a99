#include "space/boundary/border_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "scene/body_border.hpp"
#include "scene/grid_lines.hpp"
#include "scene/point_sums.hpp"
#include "space/boundary/face_pieces.hpp"
#include "space/boundary/grid_crossings.hpp"

namespace stillpoint {
namespace {

template <Kinematics K>
using Patches = std::vector<BorderPatch<K>>;

/// The pieces of a part of the border along an axis, and how many of them make a patch.
struct PieceRule {
  std::vector<FacePoint> points;
  std::size_t in_patch;
};

PieceRule rule_along(const Problem& problem, const BodySpec& body, std::size_t along) {
  if (!problem.phase.ends()) {
    const int count = degree_of(problem.grid.basis) + 1;
    return {gauss_in_parts(count, 1), static_cast<std::size_t>(count)};
  }
  const int parts = body.points_per_cell[along];
  if (problem.phase.quadrature == Quadrature::domains) return {gauss_in_parts(2, parts), 2};
  return {face_rule(body, along, /*carried=*/true, /*domains=*/false), static_cast<std::size_t>(parts)};
}

template <int Dim>
double width_of_cell(const Grid<Dim>& grid, const std::array<int, Dim>& cell) {
  double volume = 1;
  for (int d = 0; d < Dim; ++d) {
    const auto& nodes = grid.axes[d].nodes;
    volume *= nodes[static_cast<std::size_t>(cell[d]) + 1] - nodes[static_cast<std::size_t>(cell[d])];
  }
  return std::pow(volume, 1.0 / Dim);
}

/// The pieces of a surface in space, by the cells that they border.
template <Kinematics K>
class PiecesOfCells {
 public:
  explicit PiecesOfCells(const Grid<3>& grid) : grid_(grid) {}

  void add(const BorderPiece<K>& piece) { of_cells_[grid_.cell_number(piece.cell_inside(grid_))].push_back(piece); }
  void append_to(Patches<K>& patches) {
    for (auto& [cell, pieces] : of_cells_)
      patches.push_back({width_of_cell<3>(grid_, grid_.cell_at(cell)), 1, std::move(pieces)});
  }

 private:
  const Grid<3>& grid_;
  std::map<int, std::vector<BorderPiece<K>>> of_cells_;
};

template <Kinematics K>
Patches<K> along_lines(const Problem& problem, std::size_t number, const Grid<2>& grid) {
  constexpr std::size_t dim = 2;
  Patches<K> patches;
  const BodySpec& body = problem.bodies[number];
  constexpr double on_axis = 1e-12;  // of the grid's length: such a line is no border
  for (const BorderLine& line : whole_border(problem, number)) {
    if (K == Kinematics::axisymmetric &&
        std::max(line.from[0], line.to[0]) <= on_axis * (grid.axes[0].max() - grid.axes[0].min()))
      continue;
    const std::size_t across = std::abs(line.normal[0]) > std::abs(line.normal[1]) ? 0 : 1;
    const PieceRule rule = rule_along(problem, body, 1 - across);
    const std::vector<Point<dim>> ends = grid_crossings(line, grid);
    for (std::size_t c = 0; c + 1 < ends.size(); ++c) {
      const Point<dim>&from = ends[c], &to = ends[c + 1];
      const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
      std::vector<BorderPiece<K>> pieces;
      for (const auto& [xi, weight] : rule.points) {
        Point<dim> x;
        for (std::size_t d = 0; d < dim; ++d) x[d] = (from[d] + to[d]) / 2 + (to[d] - from[d]) / 2 * xi;
        const double depth = K == Kinematics::axisymmetric ? 2 * std::numbers::pi * x[0] : body.area;
        pieces.push_back(BorderPiece<K>::make(x, length / 2 * weight * depth, line.normal));
        if (pieces.size() < rule.in_patch) continue;
        const double cell = width_of_cell<dim>(grid, pieces.back().cell_inside(grid));
        patches.push_back({cell, depth, std::exchange(pieces, {})});
      }
    }
  }
  return patches;
}

template <Kinematics K>
Patches<K> on_faces(const Problem& problem, std::size_t number, const Grid<3>& grid) {
  constexpr std::size_t dim = 3;
  Patches<K> patches;
  const BodySpec& body = problem.bodies[number];
  for (const Face face : {Face::left, Face::right, Face::bottom, Face::top, Face::back, Face::front}) {
    const auto normal = static_cast<std::size_t>(axis_of(face));
    Point<dim> outwards{};
    outwards[normal] = is_upper(face) ? 1 : -1;
    PiecesOfCells<K> pieces(grid);
    for_face_pieces<dim>(
        grid, normal, (is_upper(face) ? body.max : body.min)[normal], part_of_face(face, {}, {}, body.min, body.max),
        [&](std::size_t along) { return rule_along(problem, body, along).points; },
        [&](const Point<dim>& x, double area, double) { pieces.add(BorderPiece<K>::make(x, area, outwards)); });
    pieces.append_to(patches);
  }
  return patches;
}

// A curved surface is not cut at the borders of cells, but in pieces of half a cell.
template <Kinematics K>
Patches<K> on_surfaces(const Problem& problem, std::size_t number, const Grid<3>& grid) {
  constexpr std::size_t dim = 3;
  Patches<K> patches;
  const BodySpec& body = problem.bodies[number];
  double length = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < dim; ++d) length = std::min(length, smallest_cell(problem.grid, d) / 2);
  for (const BodySurface surface : {BodySurface::outer, BodySurface::inner, BodySurface::start, BodySurface::end}) {
    if (!why_no_surface(body, surface).empty()) continue;
    PiecesOfCells<K> pieces(grid);
    for (const SurfacePiece& piece : surface_pieces(body, surface, length)) {
      const auto& [a, b, c] = piece.vector;
      const double area = std::hypot(a, b, c);
      if (area > 0) pieces.add(BorderPiece<K>::make(piece.x, area, {a / area, b / area, c / area}));
    }
    pieces.append_to(patches);
  }
  return patches;
}

}  // namespace

template <Kinematics K>
std::vector<BorderPatch<K>> border_patches(const Problem& problem, std::size_t body, const Grid<dimensions(K)>& grid) {
  if constexpr (dimensions(K) == 2) return along_lines<K>(problem, body, grid);
  if constexpr (dimensions(K) == 3)
    return problem.bodies[body].is_box() ? on_faces<K>(problem, body, grid) : on_surfaces<K>(problem, body, grid);
  return {};
}

template std::vector<BorderPatch<Kinematics::line>> border_patches(const Problem&, std::size_t, const Grid<1>&);
template std::vector<BorderPatch<Kinematics::plane>> border_patches(const Problem&, std::size_t, const Grid<2>&);
template std::vector<BorderPatch<Kinematics::axisymmetric>> border_patches(const Problem&, std::size_t, const Grid<2>&);
template std::vector<BorderPatch<Kinematics::space>> border_patches(const Problem&, std::size_t, const Grid<3>&);

}  // namespace stillpoint
