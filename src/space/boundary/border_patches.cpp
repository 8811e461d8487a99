#include "space/boundary/border_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "scene/body_border.hpp"
#include "scene/grid_lines.hpp"
#include "scene/point_sums.hpp"
#include "space/boundary/face_end.hpp"
#include "space/boundary/face_pieces.hpp"
#include "space/boundary/grid_crossings.hpp"
#include "space/grid/cells_around.hpp"

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

template <int Dim>
double cosine(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t d = 0; d < Dim; ++d) ab += a[d] * b[d], aa += a[d] * a[d], bb += b[d] * b[d];
  return ab / std::sqrt(aa * bb);
}
constexpr double like = 0.7;  // the cosine between the normals of pieces that one patch may have

/// Patches along lines. Many multipliers in a cell would drift, as where a border has sides that are shorter than
/// cells, or cuts off the corner of one: what is less than three quarters of a cell long goes on with the next.
template <Kinematics K>
class PatchesAlong {
 public:
  struct Part {
    Point<2> from, to, normal;
    double length, full_length;  // along the border: of the part, and where it goes through the whole of its cell [m]
    BorderPatch<K> patch;
  };

  void add(Part&& part) {
    constexpr double enough = 0.75;
    if (!parts_.empty() && parts_.back().length < enough * part.full_length && goes_on(parts_.back(), part)) {
      join(parts_.back(), std::move(part));
    } else {
      end_part();
      parts_.push_back(std::move(part));
    }
  }
  /// face_at(x, along): the face at which a border ends there that goes that way.
  template <class FaceAt>
  Patches<K> patches(const FaceAt& face_at) {
    end_part();
    Patches<K> patches;
    std::size_t first = 0;  // of the patches that go on
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      Part& part = parts_[k];
      const Point<2> along = {-part.normal[1], part.normal[0]};
      part.patch.goes_on = k > 0 && goes_on(parts_[k - 1], part);
      if (!part.patch.goes_on) first = k;
      part.patch.closes = goes_on(part, parts_[first]) && k > first;
      part.patch.ends = {face_at(part.from, along), face_at(part.to, along)};
      patches.push_back(std::move(part.patch));
    }
    return patches;
  }

 private:
  static bool goes_on(const Part& before, const Part& part) {
    return before.to == part.from && cosine<2>(before.normal, part.normal) > like;
  }
  static void join(Part& before, Part&& part) {
    before.to = part.to;
    before.length += part.length;
    before.patch.pieces.insert(before.patch.pieces.end(), part.patch.pieces.begin(), part.patch.pieces.end());
  }
  // What was left over before a corner goes to the part before it.
  void end_part() {
    constexpr double little = 0.5;
    const std::size_t count = parts_.size();
    if (count < 2 || parts_[count - 1].length >= little * parts_[count - 1].full_length ||
        !goes_on(parts_[count - 2], parts_[count - 1]))
      return;
    join(parts_[count - 2], std::move(parts_[count - 1]));
    parts_.pop_back();
  }

  std::vector<Part> parts_;
};

/// Patches on a surface in space: the pieces of each cell that they border, but for cells of which less than a quarter
/// of a face is there, which go to the largest one beside them.
template <Kinematics K>
class PatchesOnSurface {
 public:
  explicit PatchesOnSurface(const Grid<3>& grid) : grid_(grid) {}

  void add(const BorderPiece<K>& piece) {
    OfCell& cell = of_cells_[grid_.cell_number(piece.cell_inside(grid_))];
    cell.pieces.push_back(piece);
    cell.area += piece.area;
    for (std::size_t d = 0; d < 3; ++d) cell.vector[d] += piece.vector[d];
  }
  void append_to(Patches<K>& patches) {
    std::map<int, std::vector<BorderPiece<K>>> joined;
    for (const auto& [number, cell] : of_cells_) {
      auto& pieces = joined[place_of(number)];
      pieces.insert(pieces.end(), cell.pieces.begin(), cell.pieces.end());
    }
    for (auto& [number, pieces] : joined)
      patches.push_back({width_of_cell<3>(grid_, grid_.cell_at(number)), 1, std::move(pieces)});
  }

 private:
  struct OfCell {
    std::vector<BorderPiece<K>> pieces;
    double area = 0;
    Point<3> vector{};  // Σ n da
  };

  int place_of(int number) const {
    constexpr double little = 0.25;
    const OfCell& cell = of_cells_.at(number);
    const int largest = largest_around(number);
    return cell.area < little * of_cells_.at(largest).area ? place_of(largest) : number;
  }
  int largest_around(int number) const {
    int largest = number;
    for_cells_around(grid_, grid_.cell_at(number), 1, [&](int beside) {
      const auto found = of_cells_.find(beside);
      if (found != of_cells_.end() && found->second.area > of_cells_.at(largest).area &&
          cosine<3>(found->second.vector, of_cells_.at(number).vector) > like)
        largest = beside;
    });
    return largest;
  }

  const Grid<3>& grid_;
  std::map<int, OfCell> of_cells_;
};

/// How long a line is that goes this way through the middle of a cell [m].
double length_through(const Grid<2>& grid, const std::array<int, 2>& cell, const Point<2>& along) {
  double shares = 0;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto& nodes = grid.axes[d].nodes;
    const auto i = static_cast<std::size_t>(cell[d]);
    shares = std::max(shares, std::abs(along[d]) / (nodes[i + 1] - nodes[i]));
  }
  return std::hypot(along[0], along[1]) / shares;
}

template <Kinematics K>
Patches<K> along_lines(const Problem& problem, std::size_t number, const Grid<2>& grid) {
  constexpr std::size_t dim = 2;
  PatchesAlong<K> patches;
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
      const Point<dim> along = {to[0] - from[0], to[1] - from[1]};
      const auto at = [&](double xi) {
        return Point<dim>{(from[0] + to[0]) / 2 + along[0] / 2 * xi, (from[1] + to[1]) / 2 + along[1] / 2 * xi};
      };
      const double length = std::hypot(along[0], along[1]);
      const std::size_t parts = rule.points.size() / rule.in_patch;
      for (std::size_t part = 0; part < parts; ++part) {
        std::vector<BorderPiece<K>> pieces;
        double depth = body.area;
        for (std::size_t i = part * rule.in_patch; i < (part + 1) * rule.in_patch; ++i) {
          const auto& [xi, weight] = rule.points[i];
          const Point<dim> x = at(xi);
          if (K == Kinematics::axisymmetric) depth = 2 * std::numbers::pi * x[0];
          pieces.push_back(BorderPiece<K>::make(x, length / 2 * weight * depth, line.normal));
        }
        const std::array<int, dim> cell = pieces.back().cell_inside(grid);
        const auto end = [&](std::size_t of) {
          return of == 0 ? from : of == parts ? to : at(2 * static_cast<double>(of) / static_cast<double>(parts) - 1);
        };
        patches.add({end(part),
                     end(part + 1),
                     line.normal,
                     length / static_cast<double>(parts),
                     length_through(grid, cell, along) / static_cast<double>(parts),
                     {width_of_cell<dim>(grid, cell), depth, std::move(pieces), grid.cell_number(cell)}});
      }
    }
  }
  return patches.patches(
      [&](const Point<dim>& x, const Point<dim>& along) { return face_at<K>(problem, grid, x, along); });
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
    PatchesOnSurface<K> pieces(grid);
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
    PatchesOnSurface<K> pieces(grid);
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
