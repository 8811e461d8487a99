// Points in a grid of unequal cells: the domains that they represent, and the nearest of them.
#include <stillpoint/problem.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "largest.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/points/domain_halving.hpp"
#include "space/points/nearest_point.hpp"
#include "space/points/placed_bodies.hpp"

using namespace stillpoint;
using stillpoint::test::body_of;
using stillpoint::test::free_block;

namespace {

/// Columns of 0.5 m on the left and of 0.1 m on the right, rows that grow by a factor of 6.
Scene block_in_unequal_cells(std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"grid.x=[[0, 2, 4], [2, 4, 20]]", "grid.y=[[0, 3, 10, 6]]",
                                       "phase.quadrature=domains", "damping.strategy=cundall"});
  return free_block(overrides);
}

}  // namespace

TEST_CASE("where cells are unequal the domains of the start are whole, beside narrow cells too") {
  for (const std::string points : {"1", "4"}) {
    const Scene scene =
        block_in_unequal_cells({"body.min=[0, 0]", "body.max=[4, 3]", "body.points_per_cell=" + points});
    auto body = body_of(scene);
    const Grid<2> grid = grid_at<2>(scene, 0);
    CAPTURE(points);
    Largest off;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      const auto whole = Domain<2>::of(body.points, p).x, taken = Domain<2>::in_grid(body.points, p, grid).x;
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t d = 0; d < 2; ++d) off.take_magnitude(taken[c][d] - whole[c][d]);
    }
    CHECK(off.value() < 1e-15);
    CHECK(halve_wide_domains(body.points, grid).empty());
  }
}

TEST_CASE(
    "domains that are drawn into narrow cells are halved there alone, until none is wider than a cell it touches") {
  const Scene scene = block_in_unequal_cells({"body.min=[0, 0]", "body.max=[2, 1]"});
  const Grid<2> grid = grid_at<2>(scene, 0);
  auto body = body_of(scene);
  MaterialPoints<2>& points = body.points;
  const std::size_t before = points.size();
  // The body is moved and stretched to [1, 3.5] × [0.2, 2.4].
  const auto map = [](double x, std::size_t d) { return d == 0 ? 1 + 1.25 * x : 0.2 + 2.2 * x; };
  for (std::size_t p = 0; p < before; ++p) {
    for (std::size_t d = 0; d < 2; ++d) {
      for (std::size_t c = 0; c < 4; ++c) points.corner[2 * c + d][p] = map(points.corner[2 * c + d][p], d);
      points.x[d][p] = map(points.x[d][p], d);
    }
    points.volume[p] *= 1.25 * 2.2;
  }
  while (!halve_wide_domains(points, grid).empty()) {
  }
  PointOrder<2>().sort(points, grid);
  CHECK(points.size() > 2 * before);

  using Basis = TensorBasis<DomainBSpline<2>, 2>;
  PointWeights<DomainBSpline<2>, Kinematics::plane> weights;
  weights.rebuild(grid, points);
  std::vector<double> sum(2 * static_cast<std::size_t>(Basis::count(grid)));
  Largest outside, too_wide;
  bool some_whole = false;
  for (std::size_t k = 0; k < points.cells(); ++k) {
    const auto cell = grid.cell_at(points.cell[k]);
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      for (const auto& corner : Domain<2>::of(points, p).x) {
        for (std::size_t d = 0; d < 2; ++d) {
          const auto& lines = grid.axes[d].nodes;
          outside.take(lines[static_cast<std::size_t>(cell[d])] - corner[d]);
          outside.take(corner[d] - lines[static_cast<std::size_t>(cell[d]) + 2]);
        }
      }
      for (std::size_t d = 0; d < 2; ++d) {
        const auto& x = Domain<2>::of(points, p).x;
        const auto& lines = grid.axes[d].nodes;
        for (std::size_t c = 0; c + 1 < lines.size(); ++c) {
          const double in_common = std::min(x[3][d], lines[c + 1]) - std::max(x[0][d], lines[c]);
          if (in_common > 1e-9) too_wide.take(x[3][d] - x[0][d] - (lines[c + 1] - lines[c]));
        }
      }
      some_whole = some_whole || points.half[0][p] == 0.125;  // half of a quarter of a metre, as at the start
      for (int a = 0; a < Basis::per_cell; ++a) {
        for (std::size_t j = 0; j < 2; ++j)
          sum[2 * static_cast<std::size_t>(weights.function(k, a)) + j] +=
              points.volume[p] * weights.dN(k, p)[Basis::per_cell * static_cast<int>(j) + a];
      }
    }
  }
  CHECK(outside.value() < 1e-9);
  CHECK(too_wide.value() < 1e-9);
  CHECK(some_whole);
  // Σ_p V_p ∇N̄_ip = 0 of all functions whose three cells along each axis lie in the body.
  int inside = 0;
  Largest off;
  for (int f = 0; f < Basis::count(grid); ++f) {
    bool is_inside = true;
    for (int d = 0; d < 2; ++d) {
      const Axis& axis = grid.axes[static_cast<std::size_t>(d)];
      const int last = Basis::index_along(grid, f, d), first = last - 2;
      is_inside = is_inside && first >= 0 && last < axis.cells() &&
                  axis.nodes[static_cast<std::size_t>(first)] > map(0, static_cast<std::size_t>(d)) &&
                  axis.nodes[static_cast<std::size_t>(last) + 1] < map(d == 0 ? 2 : 1, static_cast<std::size_t>(d));
    }
    if (!is_inside) continue;
    ++inside;
    for (std::size_t j = 0; j < 2; ++j) off.take_magnitude(sum[2 * static_cast<std::size_t>(f) + j]);
  }
  CHECK(inside > 20);
  CHECK(off.value() < 1e-13);
}

TEST_CASE("the nearest point is found in cells of any lengths") {
  std::mt19937 random(7);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const Grid<2> grid{{Axis{{0, 0.01, 0.03, 1, 4, 4.2, 4.25, 5}, false}, Axis{{0, 2, 2.1, 2.11, 3}, false}}};
  for (const int count : {1, 5, 60}) {
    MaterialPoints<2> points;
    for (int p = 0; p < count; ++p) {
      points.x[0].push_back(5 * share());
      points.x[1].push_back(3 * share());
      points.number.push_back(p);
    }
    points.volume.assign(static_cast<std::size_t>(count), 1);
    points.mass = points.volume;
    points.material_begin = {0, count};
    PointOrder<2>().sort(points, grid);
    const NearestPoint<2> nearest(points, grid);
    for (int trial = 0; trial < 300; ++trial) {
      const Point<2> x = {5 * share(), 3 * share()};
      const auto distance = [&](std::size_t p) { return std::hypot(points.x[0][p] - x[0], points.x[1][p] - x[1]); };
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t p = 0; p < points.size(); ++p) least = std::min(least, distance(p));
      CHECK(distance(nearest.to(x).p) == Approx(least).epsilon(1e-12));
    }
  }
}
