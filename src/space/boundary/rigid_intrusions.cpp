// What lies in rigid bodies without being felt. Contact acts at the pieces of a border: a rigid body that has jumped
// past them, or gone in between two of them, presses on nothing from there on.
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include <Eigen/Geometry>

#include "scene/rigid_body.hpp"
#include "space/boundary/facet_search.hpp"
#include "space/boundary/rigid_contact.hpp"
#include "space/grid/shortest_side.hpp"

namespace stillpoint {
namespace {

/// Calls visit(y) for places of a rigid body's surface in a box, about a cell apart: a box from which it is too far
/// away has none of it, and another one is halved until it is as small as a cell.
template <Kinematics K, class Position, class Placement, class Visit>
void visit_surface(const TouchFinder<K>& finder, const Placement& placement, const Position& from, const Position& to,
                   double cell, const Visit& visit) {
  const Position middle = (from + to) / 2, sides = to - from;
  const auto at = finder.nearest(middle, placement);
  if (std::abs(at.distance) > sides.norm() / 2) return;
  Eigen::Index longest = 0;
  if (sides.maxCoeff(&longest) <= cell) return visit(Position(middle - at.distance * at.normal));
  Position first_to = to, second_from = from;
  first_to[longest] = second_from[longest] = middle[longest];
  visit_surface(finder, placement, from, first_to, cell, visit);
  visit_surface(finder, placement, second_from, to, cell, visit);
}

/// A share of the way from one place of a body to another.
template <int N>
RigidPlacement<N> on_the_way(const RigidPlacement<N>& from, const RigidPlacement<N>& to, double share) {
  using Turn = std::conditional_t<N == 2, Eigen::Rotation2Dd, Eigen::AngleAxisd>;
  Turn turn(Eigen::Matrix<double, N, N>(to.Q * from.Q.transpose()));
  turn.angle() *= share;
  RigidPlacement<N> placement = from;
  placement.u += share * (to.u - from.u);
  placement.Q = turn.toRotationMatrix() * from.Q;
  return placement;
}

}  // namespace

template <Kinematics K>
std::vector<Intrusion> RigidContact<K>::intrusions(const Parts& phase, double t, const double* u) const {
  std::vector<RigidPlacement<N>> placements;
  for (const RigidBody& rigid : bodies_) placements.push_back(rigid.placement(t, u));
  const std::vector<BorderPiece<K>> border = moved_pieces(surface_, u);
  std::vector<Intrusion> found;
  const auto take = [&](Intrusion one) {
    if (one.cells > 0) found.push_back(std::move(one));
  };
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    const std::vector<char> bearing = bodies_[r].bearing_patches(placements[r], u);
    const bool bears = std::ranges::any_of(bearing, [](char one) { return one != 0; });
    for (Intrusion one : {deepest_point(r, placements[r], phase, u), deepest_border(r, placements[r], bearing, u),
                          deepest_surface(r, placements[r], border)}) {
      one.bears = bears;
      take(std::move(one));
    }
    for (std::size_t other = 0; other < r; ++other) {
      if (bodies_[r].finder().is_free() || bodies_[other].finder().is_free())
        take(deepest_overlap(r, other, placements, phase.grid));
    }
  }
  return found;
}

// The bodies are where u has them at the end: a dent that has closed again behind a rigid body lies on its way, and is
// shallow.
template <Kinematics K>
std::vector<Intrusion> RigidContact<K>::passages(const Parts& phase, double before, double t, const double* u) const {
  constexpr double apart = 0.125, deeper = 0.25;  // [cells]
  constexpr double most = 2000;                   // looks on the way
  std::vector<Intrusion> found;
  for (std::size_t r = 0; r < bodies_.size(); ++r) {
    const TouchFinder<K>& finder = bodies_[r].finder();
    if (!(way(finder, before, t) > jump)) continue;
    const RigidPlacement<N> from = finder.placement(before), to = finder.placement(t);
    const double at_ends = std::max(deepest_point(r, from, phase, u).cells, deepest_point(r, to, phase, u).cells);
    const int looks = static_cast<int>(std::min(most, std::ceil(way_between(from, to) / (apart * least_cell_))));
    Intrusion deepest;
    for (int look = 1; look < looks; ++look) {
      Intrusion here = deepest_point(r, on_the_way(from, to, look * (1.0 / looks)), phase, u);
      if (here.cells > deepest.cells) deepest = std::move(here);
    }
    if (!(deepest.cells > at_ends + deeper)) continue;
    deepest.of = Intrusion::Of::way;
    found.push_back(std::move(deepest));
  }
  return found;
}

template <Kinematics K>
Intrusion RigidContact<K>::deepest_point(std::size_t r, const RigidPlacement<N>& placement, const Parts& phase,
                                         const double* u) const {
  Intrusion deepest{.of = Intrusion::Of::points, .rigid = r};
  const TouchFinder<K>& finder = bodies_[r].finder();
  typename PointFunctions<dim>::Numbers N_a;
  for (std::size_t k = 0; k < phase.points.cells(); ++k) {
    const double side = shortest_side(phase.grid, phase.weights.cell_at(k));
    for (std::size_t p = phase.points.begin(k); p < phase.points.end(k); ++p) {
      Point<dim> x = phase.place_of(p);
      if (u) phase.weights.values(k, p, N_a);
      for (int a = 0; u && a < phase.weights.functions_of_cell(); ++a) {
        const double* const of_function = u + dim * phase.weights.function(k, a);
        for (std::size_t i = 0; i < dim; ++i) x[i] += N_a[static_cast<std::size_t>(a)] * of_function[i];
      }
      const double cells = -finder.distance(x, placement) / side;
      if (!(cells > deepest.cells)) continue;
      const std::size_t body = body_of(first_number_, phase.points.number[p]);
      const bool is_looked_at = u || !bodies_[r].was_there(body);
      if (is_looked_at && finder.touches(body)) deepest.take(cells, body, x);
    }
  }
  if (const Ranks* ranks = phase.corner_sum.ranks()) {
    struct OfRank {
      double cells;
      std::size_t other;
      Point<dim> x;
    };
    OfRank mine{deepest.cells, deepest.other, {}};
    std::ranges::copy(deepest.at, mine.x.begin());
    for (const OfRank& of : of_all(ranks, mine))
      if (of.cells > deepest.cells) deepest.take(of.cells, of.other, of.x);
  }
  return deepest;
}

// Along the lines through the pieces of a patch that bears nothing, from end to end: two Gauss points of it, or more
// where it was joined of parts. Of one that bears only the ends are looked at, which may be corners of the body.
template <Kinematics K>
Intrusion RigidContact<K>::deepest_border(std::size_t r, const RigidPlacement<N>& placement,
                                          const std::vector<char>& bearing, const double* u) const {
  constexpr double beyond = 0.4226497308103742;  // 1 − 1/√3: from a Gauss point to the end, in half lengths of its part
  constexpr int looks = 8;                       // along a line
  Intrusion deepest{.of = Intrusion::Of::border, .rigid = r};
  const TouchFinder<K>& finder = bodies_[r].finder();
  const auto patches = surface_.patches();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    if (!finder.touches(patches[k].body)) continue;
    std::vector<Point<dim>> x;
    std::vector<double> to_end;  // [m]
    for (std::size_t s = patches[k].begin; s < patches[k].end; ++s) {
      x.push_back(surface_.position(s, u));
      to_end.push_back(beyond * std::pow(surface_.area(s) / patches[k].depth, 1.0 / std::max(1, dim - 1)));
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = i + 1; j < x.size(); ++j) {
        const double length = (TouchFinder<K>::position_of(x[j]) - TouchFinder<K>::position_of(x[i])).norm();
        for (int look = 0; look <= looks; look += bearing[k] ? looks : 1) {
          const double share = look * (1.0 / looks), along = (1 - share) * -to_end[i] + share * (length + to_end[j]);
          Point<dim> between;
          for (std::size_t d = 0; d < dim; ++d) between[d] = x[i][d] + along / length * (x[j][d] - x[i][d]);
          if (K == Kinematics::axisymmetric && between[0] < 0) continue;  // the border ends on the axis
          deepest.take(-finder.distance(between, placement) / patches[k].cell, patches[k].body, between);
        }
      }
    }
  }
  return deepest;
}

// A border that is pushed in goes around what pushes it: a surface that lies below it by more than a cell has gone in
// between its pieces.
template <Kinematics K>
Intrusion RigidContact<K>::deepest_surface(std::size_t r, const RigidPlacement<N>& placement,
                                           const std::vector<BorderPiece<K>>& border) const {
  constexpr double far = 4;  // extents of the grid: a border as long as that is no border any more
  Intrusion deepest{.of = Intrusion::Of::surface, .rigid = r};
  const TouchFinder<K>& finder = bodies_[r].finder();
  for (const auto& part : surface_.parts()) {
    if (!finder.touches(part.body)) continue;
    const auto patches = surface_.patches().subspan(part.first_patch, part.end_patch - part.first_patch);
    if (patches.empty()) continue;
    const FacetSearch<K> search(patches, border);
    const double cell = std::ranges::min_element(patches, {}, &SurfacePatch::cell)->cell;
    const auto look = [&](const Position& at) {
      Point<dim> x;
      for (int d = 0; d < dim; ++d) x[static_cast<std::size_t>(d)] = at[d];
      deepest.take(search.depth(x) / cell, part.body, x);
    };
    for (const std::vector<double>& corner : corners_of(finder.spec()))
      look(placement.to_space(Position(corner.data())));
    const auto [low, high] = search.box();
    const Position from = TouchFinder<K>::position_of(low), to = TouchFinder<K>::position_of(high);
    if ((to - from).maxCoeff() <= far * surface_.extent()) visit_surface(finder, placement, from, to, cell, look);
  }
  return deepest;
}

// The place that lies deepest in both: of a lattice over the grid, and from there by ever shorter ways.
template <Kinematics K>
Intrusion RigidContact<K>::deepest_overlap(std::size_t r, std::size_t other,
                                           const std::vector<RigidPlacement<N>>& placements,
                                           const Grid<dim>& grid) const {
  constexpr int in_a_cell = 2;
  const double side = shortest_side(grid, std::array<int, static_cast<std::size_t>(dim)>{});
  const auto depth = [&](const Point<dim>& x) {
    return -std::max(bodies_[r].finder().distance(x, placements[r]),
                     bodies_[other].finder().distance(x, placements[other]));
  };
  std::array<int, dim> count, at{};
  for (std::size_t axis = 0; axis < dim; ++axis) count[axis] = in_a_cell * grid.axes[axis].cells() + 1;
  Point<dim> best{};
  double most = -std::numeric_limits<double>::infinity();
  const auto take = [&](const Point<dim>& x) {
    const double here = depth(x);
    if (!(here > most)) return false;
    most = here;
    best = x;
    return true;
  };
  for (std::size_t axis = 0; axis < dim;) {
    Point<dim> x;
    for (std::size_t d = 0; d < dim; ++d) {
      const Axis& along = grid.axes[d];
      x[d] = along.min() + (along.max() - along.min()) * at[d] / (count[d] - 1);
    }
    take(x);
    for (axis = 0; axis < dim && ++at[axis] == count[axis];) at[axis++] = 0;
  }
  constexpr double shortest = 1e-3;  // [cells]
  for (double way = side / in_a_cell; way > shortest * side;) {
    bool nearer = false;
    for (std::size_t d = 0; d < dim; ++d) {
      for (const double step : {-way, way}) {
        Point<dim> x = best;
        x[d] += step;
        nearer = take(x) || nearer;
      }
    }
    if (!nearer) way /= 2;
  }
  Intrusion deepest{.of = Intrusion::Of::rigid, .rigid = r};
  deepest.take(most / side, other, best);
  return deepest;
}

template std::vector<Intrusion> RigidContact<Kinematics::line>::intrusions(const Parts&, double, const double*) const;
template std::vector<Intrusion> RigidContact<Kinematics::plane>::intrusions(const Parts&, double, const double*) const;
template std::vector<Intrusion> RigidContact<Kinematics::axisymmetric>::intrusions(const Parts&, double,
                                                                                   const double*) const;
template std::vector<Intrusion> RigidContact<Kinematics::space>::intrusions(const Parts&, double, const double*) const;

template std::vector<Intrusion> RigidContact<Kinematics::line>::passages(const Parts&, double, double,
                                                                         const double*) const;
template std::vector<Intrusion> RigidContact<Kinematics::plane>::passages(const Parts&, double, double,
                                                                          const double*) const;
template std::vector<Intrusion> RigidContact<Kinematics::axisymmetric>::passages(const Parts&, double, double,
                                                                                 const double*) const;
template std::vector<Intrusion> RigidContact<Kinematics::space>::passages(const Parts&, double, double,
                                                                          const double*) const;

}  // namespace stillpoint
