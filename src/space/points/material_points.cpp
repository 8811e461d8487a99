#include "space/points/material_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "base/stop_request.hpp"
#include "geometry/polygon.hpp"
#include "scene/body_solid.hpp"
#include "scene/point_file.hpp"
#include "space/points/cell_positions.hpp"
#include "space/points/cut_cell_rule.hpp"
#include "space/points/moment_fit.hpp"
#include "space/points/point_collector.hpp"
#include "space/points/solid_cell_rule.hpp"

namespace stillpoint {
namespace {

constexpr double kRounding = 1e-12;  // a share of a cell's length or area that counts as none
constexpr double kSliver = 1e-6;     // a share of a cell's area, or volume, that gets no point

/// A box, an interval along each coordinate.
template <int Dim>
struct Box {
  Point<Dim> low, high;

  double size() const {
    double product = 1;
    for (int d = 0; d < Dim; ++d) product *= high[d] - low[d];
    return product;
  }
  Point<Dim> half() const {
    Point<Dim> r;
    for (int d = 0; d < Dim; ++d) r[d] = (high[d] - low[d]) / 2;
    return r;
  }
  /// The position in the box of ξ in [−1, 1]^Dim.
  Point<Dim> position(const Eigen::MatrixXd& xi, Eigen::Index p) const {
    Point<Dim> x;
    for (int d = 0; d < Dim; ++d) x[d] = low[d] + 0.5 * (1 + xi(d, p)) * (high[d] - low[d]);
    return x;
  }
};

/// Fills a box or another shape with points.
template <int Dim>
class Filling {
 public:
  Filling(const BodySpec& body, const Grid<Dim>& grid, PointCollector<Dim>& points, CellShares& covered, bool domains)
      : body_(body), grid_(grid), points_(points), covered_(covered), domains_(domains), positions_(body) {
    if (Dim == 3 && body.has_shape()) solid_ = solid_of(body);
  }

  QuadratureReport run() {
    for (int number = 0; number < grid_.cells(); ++number) {
      heed_stop_request();
      const Box<Dim> cell = box_of(number);
      Box<Dim> part = cell;
      for (int d = 0; d < Dim; ++d) {
        part.low[d] = std::max(cell.low[d], body_.min[d]);
        part.high[d] = std::min(cell.high[d], body_.max[d]);
      }
      if (smallest_share(part, cell) <= kRounding) continue;
      if (body_.is_box()) {
        fill(number, part, cell);
      } else {
        fill_shape(number, part, cell);
      }
    }
    return quadrature_;
  }

 private:
  Box<Dim> box_of(int number) const {
    const auto cell = grid_.cell_at(number);
    Box<Dim> box;
    for (int d = 0; d < Dim; ++d) {
      box.low[d] = grid_.axes[d].nodes[cell[d]];
      box.high[d] = grid_.axes[d].nodes[cell[d] + 1];
    }
    return box;
  }

  /// The smallest share of the cell's lengths that the part has; not positive if the part is empty.
  static double smallest_share(const Box<Dim>& part, const Box<Dim>& cell) {
    double share = 1;
    for (int d = 0; d < Dim; ++d) share = std::min(share, (part.high[d] - part.low[d]) / (cell.high[d] - cell.low[d]));
    return share;
  }

  /// Fills a part of a cell that is a box with the whole pattern.
  void fill(int number, const Box<Dim>& part, const Box<Dim>& cell) {
    const Eigen::MatrixXd& xi = positions_.next();
    if (fit_.weights.size() == 0 || positions_.vary()) {
      fit_ = body_.volumes == VolumeRule::consistent ? fit_moments(xi) : equal_weights(xi);
      if (domains_) fit_.weights.setConstant(1.0 / static_cast<double>(xi.cols()));
    }
    quadrature_.add({.degree = fit_.degree,
                     .equal_volumes = body_.volumes == VolumeRule::equal,
                     .smallest_share = smallest_share(part, cell),
                     .cells_limited_by_sign = fit_.limited_by_sign ? 1 : 0});
    covered_.emplace_back(number, part.size() / cell.size());
    points_.begin_cell(number);
    Point<Dim> r = part.half();
    for (int d = 0; d < Dim; ++d) r[d] /= body_.points_per_cell[static_cast<std::size_t>(d)];
    for (Eigen::Index p = 0; p < xi.cols(); ++p) {
      points_.add(part.position(xi, p), fit_.weights(p) * part.size());
      if (domains_) points_.add_domain(r);
    }
  }

  void fill_shape(int number, const Box<Dim>& part, const Box<Dim>& cell) {
    if constexpr (Dim == 2) fill_polygon(number, cell);
    if constexpr (Dim == 3) fill_solid(number, part, cell);
  }

  /// Fills the part of a cell that lies in the polygon.
  void fill_polygon(int number, const Box<Dim>& cell) {
    Polygon local;  // corners in coordinates in which the cell is the unit square
    for (const auto& corner : body_.polygon)
      local.push_back({(corner[0] - cell.low[0]) / (cell.high[0] - cell.low[0]),
                       (corner[1] - cell.low[1]) / (cell.high[1] - cell.low[1])});
    const Polygon part = clipped_to_unit_square(local);
    const double share = std::abs(signed_area(part));
    if (share > 1 - kRounding) return fill(number, cell, cell);
    if (share < kSliver) return;

    const CutCellRule cut = rule_of_cut_cell(local, part);
    QuadratureReport of_cell{.degree = {}, .smallest_share = extent_of(part)};
    of_cell.border_cells[static_cast<std::size_t>(cut.degree)] = 1;
    quadrature_.add(of_cell);
    covered_.emplace_back(number, share);
    points_.begin_cell(number);
    for (std::size_t p = 0; p < cut.points.x.size(); ++p) {
      Point<Dim> x;
      for (std::size_t d = 0; d < 2; ++d) {
        // a point on a line of the grid, to rounding, stays in its cell
        const double at = std::clamp(cut.points.x[p][d], kRounding, 1 - kRounding);
        x[d] = cell.low[d] + at * (cell.high[d] - cell.low[d]);
      }
      points_.add(x, cut.points.share[p] * share * cell.size());
    }
  }

  /// Fills the part of the solid in a part of a cell that is a box.
  void fill_solid(int number, const Box<Dim>& part, const Box<Dim>& cell) {
    const SpaceBox box{part.low, part.high};
    const Solid::Part known = solid_->part_of(box);
    if (known == Solid::Part::none) return;
    if (known == Solid::Part::all) return fill(number, part, cell);
    const Eigen::MatrixXd& xi = positions_.next();
    const CellPart inside(*solid_, box, static_cast<std::size_t>(xi.cols()));
    if (!(inside.volume() > kSliver * cell.size())) return;
    if (!positions_.vary() && inside.volume() > (1 - kRounding) * part.size()) return fill(number, part, cell);

    const SolidCellRule cut = rule_of_cut_cell(inside, part, xi);
    QuadratureReport of_cell{.degree = {}, .smallest_share = 1};
    for (std::size_t d = 0; d < 3; ++d)
      of_cell.smallest_share = std::min(of_cell.smallest_share, inside.extent(d) / (cell.high[d] - cell.low[d]));
    of_cell.border_cells[static_cast<std::size_t>(cut.degree)] = 1;
    quadrature_.add(of_cell);
    covered_.emplace_back(number, inside.volume() / cell.size());
    points_.begin_cell(number);
    for (std::size_t p = 0; p < cut.x.size(); ++p) {
      Point<Dim> x;
      for (std::size_t d = 0; d < 3; ++d) {
        const double rounding = kRounding * (cell.high[d] - cell.low[d]);
        x[d] = std::clamp(cut.x[p][d], cell.low[d] + rounding, cell.high[d] - rounding);
      }
      points_.add(x, cut.share[p] * inside.volume());
    }
  }

  SolidCellRule rule_of_cut_cell(const CellPart& inside, const Box<Dim>& part, const Eigen::MatrixXd& xi) const {
    const bool fitted = body_.volumes == VolumeRule::consistent;
    if (fitted && body_.placement == Placement::gauss && !positions_.vary()) return inside.gauss_points();
    std::vector<SpacePoint> x;
    for (Eigen::Index p = 0; p < xi.cols(); ++p)
      if (const auto position = part.position(xi, p); solid_->contains(position)) x.push_back(position);
    return fitted ? inside.fitted_shares(std::move(x)) : inside.equal_shares(std::move(x));
  }

  /// polygon and part: in coordinates in which the cell is the unit square.
  CutCellRule rule_of_cut_cell(const Polygon& polygon, const Polygon& part) {
    const Eigen::MatrixXd& xi = positions_.next();
    const bool fitted = body_.volumes == VolumeRule::consistent;
    if (fitted && body_.placement == Placement::gauss && !positions_.vary())
      return gauss_points(part, static_cast<std::size_t>(xi.cols()));
    std::vector<PlanePoint> inside;
    for (Eigen::Index p = 0; p < xi.cols(); ++p) {
      const PlanePoint x{0.5 * (1 + xi(0, p)), 0.5 * (1 + xi(1, p))};
      if (contains(polygon, x)) inside.push_back(x);
    }
    if (inside.empty()) inside.push_back(centroid(part));
    return fitted ? fitted_shares(part, inside) : equal_shares(part, inside);
  }

  /// The smaller of a part's two extents.
  static double extent_of(const Polygon& part) {
    double smallest = 1;
    for (std::size_t d = 0; d < 2; ++d) {
      const auto [low, high] = std::ranges::minmax_element(part, {}, [d](const Point<2>& corner) { return corner[d]; });
      smallest = std::min(smallest, (*high)[d] - (*low)[d]);
    }
    return smallest;
  }

  const BodySpec& body_;
  const Grid<Dim>& grid_;
  PointCollector<Dim>& points_;
  CellShares& covered_;
  bool domains_;
  CellPositions<Dim> positions_;
  std::shared_ptr<const Solid> solid_;  // the solid of a body in space that is not a box
  MomentFit fit_;
  QuadratureReport quadrature_;
};

/// Takes the points of a file, sorted by cell; in one dimension by position.
template <int Dim>
void take_from_file(const std::filesystem::path& file, const Grid<Dim>& grid, PointCollector<Dim>& points) {
  std::vector<double> min, max;
  for (const Axis& axis : grid.axes) {
    min.push_back(axis.min());
    max.push_back(axis.max());
  }
  std::vector<Mistake> problems;
  const PointFile read = read_point_file(file, min, max, problems);
  if (!problems.empty()) throw SceneError(std::move(problems));

  const std::size_t count = read.volume.size();
  std::vector<Point<Dim>> x(count);
  std::vector<int> cell(count);
  for (std::size_t p = 0; p < count; ++p) {
    for (int d = 0; d < Dim; ++d) x[p][d] = read.x[d][p];
    cell[p] = grid.cell_number(grid.cell_of(x[p]));
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) {
    return cell[p] != cell[q] ? cell[p] < cell[q] : Dim == 1 && x[p] < x[q];
  });
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t p = order[k];
    if (k == 0 || cell[p] != cell[order[k - 1]]) points.begin_cell(cell[p]);
    points.add_volume(x[p], read.volume[p]);
  }
}

}  // namespace

void QuadratureReport::add(const QuadratureReport& other) {
  if (other.degree && (!degree || *other.degree < *degree)) {
    degree = other.degree;
    equal_volumes = other.equal_volumes;
  }
  for (std::size_t d = 0; d < border_cells.size(); ++d) border_cells[d] += other.border_cells[d];
  smallest_share = std::min(smallest_share, other.smallest_share);
  cells_limited_by_sign += other.cells_limited_by_sign;
}

int QuadratureReport::border_cells_below(int needed) const {
  return std::accumulate(border_cells.begin(), border_cells.begin() + needed, 0);
}

template <int Dim>
PlacedBody<Dim> place_body(const BodySpec& body, const Grid<Dim>& grid, double density, StressState state,
                           bool domains) {
  PlacedBody<Dim> placed;
  PointCollector<Dim> points(body.area, density, state);
  if (body.file.empty()) {
    placed.quadrature = Filling<Dim>(body, grid, points, placed.covered, domains).run();
  } else {
    take_from_file(body.file, grid, points);
  }
  placed.points = points.finish();
  return placed;
}

template PlacedBody<1> place_body<1>(const BodySpec&, const Grid<1>&, double, StressState, bool);
template PlacedBody<2> place_body<2>(const BodySpec&, const Grid<2>&, double, StressState, bool);
template PlacedBody<3> place_body<3>(const BodySpec&, const Grid<3>&, double, StressState, bool);

}  // namespace stillpoint
