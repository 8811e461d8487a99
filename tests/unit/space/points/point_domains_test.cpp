#include "space/points/point_domains.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "largest.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/points/domain_halving.hpp"
#include "space/points/placed_bodies.hpp"

using namespace stillpoint;
using Catch::Contains;
using stillpoint::test::body_of;
using stillpoint::test::free_block;
using stillpoint::test::free_soil;

namespace {

// A smooth map that is not affine and takes no domain outside the grid.
Point<2> bent(const Point<2>& x) {
  return {x[0] + 0.05 * x[0] * x[1] - 0.03 * x[1], x[1] + 0.04 * x[0] * x[0] - 0.02 * x[0]};
}

// The block of free_block(), bent, in the order of its new cells.
MaterialPoints<2> bent_block(const Scene& scene) {
  auto body = body_of(scene);
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    Point<2> mean{};
    for (std::size_t c = 0; c < 4; ++c) {
      const Point<2> to = bent({body.points.corner[2 * c][p], body.points.corner[2 * c + 1][p]});
      for (std::size_t d = 0; d < 2; ++d) {
        body.points.corner[2 * c + d][p] = to[d];
        mean[d] += to[d] / 4;
      }
    }
    for (std::size_t d = 0; d < 2; ++d) body.points.x[d][p] = mean[d];
  }
  PointOrder<2>().sort(body.points, grid_at<2>(scene, 0));
  return std::move(body.points);
}

}  // namespace

TEST_CASE("domains of uniform points fill their cells with equal volumes, whatever volumes are asked for") {
  for (const std::string volumes : {"equal", "consistent"}) {
    const auto body =
        body_of(free_block({"phase.quadrature=domains", "body.points_per_cell=9", "body.volumes=" + volumes}));
    Largest off;
    double area = 0;
    for (std::size_t p = 0; p < body.points.size(); ++p) {
      const auto x = Domain<2>::of(body.points, p).x;
      const double of_domain = (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]);
      off.take_magnitude(of_domain - body.points.volume[p]);
      area += of_domain;
    }
    CAPTURE(volumes);
    CHECK(off.value() < 1e-15);
    CHECK(area == Approx(1.25 * 0.5).epsilon(1e-13));
  }
}

TEMPLATE_TEST_CASE("over bent domains weights sum to 1, reproduce positions, and gradients of linear fields", "",
                   DomainBSpline<1>, DomainBSpline<2>, DomainBSpline<3>) {
  using Basis = TensorBasis<TestType, 2>;
  const Scene scene = free_block({"phase.quadrature=domains"});
  const Grid<2> grid = grid_at<2>(scene, 0);
  const MaterialPoints<2> points = bent_block(scene);
  PointWeights<TestType, Kinematics::plane> weights;
  weights.rebuild(grid, points);
  Largest of_sum, of_position, of_gradient;
  for (std::size_t k = 0; k < points.cells(); ++k) {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      double sum = 0;
      Point<2> position{};
      std::array<double, 4> gradient{};
      for (int a = 0; a < Basis::per_cell; ++a) {
        sum += weights.N(k, p)[a];
        for (int i = 0; i < 2; ++i) {
          const double centre = TestType::centre(grid.axes[i], Basis::index_along(grid, weights.function(k, a), i));
          position[i] += centre * weights.N(k, p)[a];
          for (int j = 0; j < 2; ++j) gradient[2 * i + j] += centre * weights.dN(k, p)[Basis::per_cell * j + a];
        }
      }
      of_sum.take_magnitude(sum - 1);
      for (std::size_t d = 0; d < 2; ++d) of_position.take_magnitude(position[d] - points.x[d][p]);
      for (std::size_t c = 0; c < 4; ++c) of_gradient.take_magnitude(gradient[c] - (c % 3 == 0 ? 1 : 0));
    }
  }
  CHECK(of_sum.value() < 1e-13);
  CHECK(of_position.value() < 1e-13);
  CHECK(of_gradient.value() < 1e-12);
}

TEST_CASE("a domain wider than a cell is shrunk about its point, and none reaches out of the grid") {
  const Scene scene = free_block({"phase.quadrature=domains"});
  const Grid<2> grid = grid_at<2>(scene, 0);
  auto body = body_of(scene);
  for (std::size_t c = 0; c < 4; ++c) {
    body.points.corner[2 * c][0] = body.points.x[0][0] + (c & 1 ? 0.4 : -0.4);
    body.points.corner[2 * c + 1][0] = body.points.x[1][0] + (c & 2 ? 0.1 : -0.5);
  }
  const auto x = Domain<2>::in_grid(body.points, 0, grid).x;
  CHECK(x[1][0] - x[0][0] == Approx(0.25).epsilon(1e-14));
  CHECK((x[0][0] + x[1][0]) / 2 == Approx(body.points.x[0][0]).epsilon(1e-14));
  for (const auto& corner : x) {
    CHECK(corner[1] >= 0);
    CHECK(corner[1] <= 1);
  }
}

TEST_CASE("a domain's deformation is that of its corners since the start") {
  const Scene scene = free_block({"phase.quadrature=domains"});
  auto body = body_of(scene);
  for (std::size_t c = 0; c < 4; ++c) {
    const double X = body.points.corner[2 * c][3], Y = body.points.corner[2 * c + 1][3];
    body.points.corner[2 * c][3] = 1.2 * X + 0.3 * Y + 4;
    body.points.corner[2 * c + 1][3] = -0.1 * X + 0.9 * Y - 2;
  }
  const auto F = Domain<2>::of(body.points, 3).deformation({body.points.half[0][3], body.points.half[1][3]});
  CHECK(F[0] == Approx(1.2).epsilon(1e-12));
  CHECK(F[1] == Approx(0.3).epsilon(1e-12));
  CHECK(F[2] == Approx(-0.1).epsilon(1e-12));
  CHECK(F[3] == Approx(0.9).epsilon(1e-12));
}

TEST_CASE("elastic boxes of uniform points take domains, all others points, and domains that cannot be are refused") {
  const auto quadrature = [](std::vector<std::string> overrides) {
    overrides.insert(overrides.begin(), "damping.strategy=cundall");
    return free_block(overrides).phase.quadrature;
  };
  CHECK(quadrature({}) == Quadrature::domains);
  CHECK(quadrature({"damping.strategy=none"}) == Quadrature::points);
  CHECK(quadrature({"phase.quadrature=points"}) == Quadrature::points);
  CHECK(quadrature({"phase.max_motion=none"}) == Quadrature::points);
  CHECK(quadrature({"body.placement=gauss"}) == Quadrature::points);
  CHECK(quadrature({"body.jitter=0.1"}) == Quadrature::points);
  CHECK(quadrature({"body.state=axisymmetric"}) == Quadrature::points);
  CHECK(quadrature({"phase.dilatation=cells"}) == Quadrature::points);
  CHECK_THROWS_WITH(free_block({"phase.quadrature=domains", "phase.dilatation=cells"}),
                    Contains("phase.quadrature") && Contains("domains reach beyond the cells"));
  CHECK(free_soil().phase.quadrature == Quadrature::points);
  CHECK(free_soil({"phase.quadrature=domains"}).phase.quadrature == Quadrature::domains);
  for (const char* other : {"body.placement=gauss", "body.state=axisymmetric"}) {
    CHECK_THROWS_WITH(free_block({"phase.quadrature=domains", other}),
                      Contains("phase.quadrature") && Contains("no domains side by side"));
  }
  CHECK_THROWS_WITH(free_block({"phase={max_motion='none', quadrature='domains'}"}),
                    Contains("phase.quadrature") && Contains("goes with phases only"));
}

TEST_CASE("elastic bodies of domains take affine velocities, all others flip, and whoever says how is heard") {
  const auto transfer = [](std::vector<std::string> overrides) {
    overrides.insert(overrides.begin(), "damping.strategy=cundall");
    return free_block(overrides).phase.transfer;
  };
  CHECK(transfer({}) == Transfer::apic);
  CHECK(transfer({"phase.transfer=flip"}) == Transfer::flip);
  CHECK(transfer({"phase.flip_share=0.9"}) == Transfer::flip);
  CHECK(transfer({"phase.quadrature=points"}) == Transfer::flip);
  CHECK(transfer({"damping.strategy=none", "phase.quadrature=domains"}) == Transfer::flip);
  CHECK(free_soil({"phase.quadrature=domains", "damping.strategy=cundall"}).phase.transfer == Transfer::flip);
}

TEST_CASE("domains stretched over more than a cell are halved until none is, and are in the same equilibrium") {
  const Scene scene = free_block({"phase.quadrature=domains", "grid.max=[10, 10]", "grid.cells=[40, 40]"});
  const Grid<2> grid = grid_at<2>(scene, 0);
  auto body = body_of(scene);
  MaterialPoints<2>& points = body.points;
  const std::size_t before = points.size();
  const auto map = [](Point<2> x) { return Point<2>{3 + 4.3 * x[0], 2 + 1.4 * x[0] + 2.6 * x[1]}; };
  for (std::size_t p = 0; p < before; ++p) {
    for (std::size_t c = 0; c < 4; ++c) {
      const Point<2> to = map({points.corner[2 * c][p], points.corner[2 * c + 1][p]});
      for (std::size_t d = 0; d < 2; ++d) points.corner[2 * c + d][p] = to[d];
    }
    const Point<2> to = map(points.position(p));
    for (std::size_t d = 0; d < 2; ++d) points.x[d][p] = to[d];
    points.volume[p] *= 4.3 * 2.6;
  }
  int rounds = 0;
  while (!halve_wide_domains(points, grid).empty()) ++rounds;
  PointOrder<2>().sort(points, grid);
  CHECK(rounds >= 3);
  CHECK(points.size() >= 4 * before);

  using Basis = TensorBasis<DomainBSpline<2>, 2>;
  PointWeights<DomainBSpline<2>, Kinematics::plane> weights;
  weights.rebuild(grid, points);
  const std::size_t unknowns = 2 * static_cast<std::size_t>(Basis::count(grid));
  std::vector<double> sum(unknowns);
  std::vector<double> size(unknowns);
  std::vector<double> mass(before);
  Largest too_wide, off_position;
  for (std::size_t k = 0; k < points.cells(); ++k) {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      const auto domain = Domain<2>::of(points, p);
      for (std::size_t c = 0; c < 4; ++c) {
        const auto& x = domain.x[c];
        for (std::size_t d = 0; d < 2; ++d) too_wide.take(std::abs(x[d] - domain.x[3 - c][d]) - 0.25);
        const Point<2> to = map({points.rest[0][p] + (c & 1 ? 1 : -1) * points.half[0][p],
                                 points.rest[1][p] + (c & 2 ? 1 : -1) * points.half[1][p]});
        for (std::size_t d = 0; d < 2; ++d) off_position.take_magnitude(x[d] - to[d]);
      }
      mass[static_cast<std::size_t>(points.number[p])] += points.mass[p];
      for (int a = 0; a < Basis::per_cell; ++a) {
        const auto f = 2 * static_cast<std::size_t>(weights.function(k, a));
        for (std::size_t j = 0; j < 2; ++j) {
          const double share = points.volume[p] * weights.dN(k, p)[Basis::per_cell * static_cast<int>(j) + a];
          sum[f + j] += share;
          size[f + j] += std::abs(share);
        }
      }
    }
  }
  CHECK(too_wide.value() < 1e-9);
  CHECK(off_position.value() < 1e-12);
  for (const double m : mass) CHECK(m == Approx(mass[0]).epsilon(1e-12));
  // Σ_p V_p ∇N̄_ip = 0 of all functions that reach no surface: there are some.
  int inside = 0;
  for (std::size_t f = 0; f < sum.size(); ++f) inside += size[f] > 0.05 && std::abs(sum[f]) < 1e-13;
  CHECK(inside > 40);
}

TEST_CASE(
    "halves of a domain that is no parallelogram share its volume as they cover it, and one with a long edge stays "
    "whole") {
  const Scene scene = free_block({"phase.quadrature=domains"});
  const Grid<2> grid = grid_at<2>(scene, 0);
  const auto with_corners = [&](const std::array<Point<2>, 4>& x) {
    auto points = body_of(scene).points;
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t d = 0; d < 2; ++d) points.corner[2 * c + d][0] = x[c][d];
    }
    points.volume[0] = 3 * Domain<2>::of(points, 0).size();
    return points;
  };
  auto wedge = with_corners({{{1, 0.5}, {1.4, 0.5}, {1, 0.7}, {1.4, 0.55}}});
  const std::size_t before = wedge.size();
  CHECK(halve_wide_domains(wedge, grid).size() == before + 1);
  CHECK(wedge.number[0] == wedge.number[1]);
  CHECK(wedge.volume[0] == Approx(3 * 0.2 * (0.2 + 0.125) / 2).epsilon(1e-12));
  CHECK(wedge.volume[1] == Approx(3 * 0.2 * (0.125 + 0.05) / 2).epsilon(1e-12));
  CHECK(wedge.mass[0] == wedge.mass[1]);

  auto trapezium = with_corners({{{1, 0.5}, {1.3, 0.5}, {1.1, 0.6}, {1.2, 0.6}}});
  CHECK(halve_wide_domains(trapezium, grid).empty());
}
