// What a phase begins with and ends with, in passes over whole cells, beside sums point by point.
#include "space/kernels/nodal_totals.hpp"

#include <cmath>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/kernels/point_motion.hpp"
#include "space/points/material_points.hpp"
#include "space/points/point_order.hpp"

using namespace stillpoint;

namespace {

/// A body with one to a dozen points in a cell, some of them on the lines of the grid, and random velocities.
template <AxisBasis B, Kinematics K>
struct RandomBody {
  static constexpr bool of_domains = B::window > 1;

  RandomBody() {
    grid.axes = {Axis::uniform(1, 6, 5), Axis::uniform(0, 4, 4)};
    grid.axes[0].nodes.back() = 5.7;  // next to a wall that the grid follows
    BodySpec body;
    body.min = {1, 1};
    body.max = {4, 3};
    body.points_per_cell = {3, 2};
    body.volumes = VolumeRule::equal;
    points =
        place_body<2>(body, grid, 1.5,
                      K == Kinematics::axisymmetric ? StressState::axisymmetric : StressState::plane_strain, of_domains)
            .points;
    const std::size_t n = points.size();
    points.number.resize(n);
    std::iota(points.number.begin(), points.number.end(), 0);
    points.material_begin = {0, static_cast<int>(n)};
    for (auto& v : points.v) v.assign(n, 0);
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t d = 0; d < 2; ++d) {
        points.v[d][p] = number(-1, 1);
        if (!of_domains) points.x[d][p] += number(-0.4, 0.4);
      }
      points.volume[p] *= number(0.5, 1.5);
    }
    if (!of_domains) points.x[0][7] = 2;
    PointOrder<2>().sort(points, grid);
    totals.begin(grid, points, weights, {modulus});
    std::vector<int> function_of_corner;
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (int a = 0; a < weights.per_cell; ++a) function_of_corner.push_back(weights.function(k, a));
    }
    corner_sum.rebuild(function_of_corner, static_cast<std::size_t>(TensorBasis<B, 2>::count(grid)));
    totals.sum(corner_sum);
  }
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }

  static constexpr double modulus = 3;
  std::mt19937 random{5};
  Grid<2> grid;
  MaterialPoints<2> points;
  PointWeights<B, K> weights;
  CornerSum corner_sum;
  NodalTotals<B, K> totals;
};

template <class Basis, Kinematics Of>
struct Case {
  using B = Basis;
  static constexpr Kinematics K = Of;
};

using Cases = std::tuple<Case<BSpline<1>, Kinematics::plane>, Case<BSpline<2>, Kinematics::plane>,
                         Case<BSpline<3>, Kinematics::plane>, Case<BSpline<1>, Kinematics::axisymmetric>,
                         Case<BSpline<2>, Kinematics::axisymmetric>, Case<DomainBSpline<1>, Kinematics::plane>,
                         Case<DomainBSpline<3>, Kinematics::plane>>;

}  // namespace

TEMPLATE_LIST_TEST_CASE("masses, stiffness bounds and momenta of a phase's start are sums over its points", "", Cases) {
  using B = typename TestType::B;
  RandomBody<B, TestType::K> block;
  const std::size_t functions = block.corner_sum.functions();
  std::vector<double> mass(functions), bound(functions), momentum(2 * functions);
  for (std::size_t k = 0; k < block.points.cells(); ++k) {
    for (std::size_t p = block.points.begin(k); p < block.points.end(k); ++p) {
      const auto N = block.weights.N(k, p);
      const auto dN = block.weights.dN(k, p);
      std::vector<double> length;
      for (int a = 0; a < block.weights.per_cell; ++a) {
        double square = 0;
        for (int j = 0; j < block.weights.rows; ++j) square += std::pow(dN[block.weights.per_cell * j + a], 2);
        length.push_back(std::sqrt(square));
      }
      const double together = std::accumulate(length.begin(), length.end(), 0.0);
      for (int a = 0; a < block.weights.per_cell; ++a) {
        const auto f = static_cast<std::size_t>(block.weights.function(k, a));
        mass[f] += block.points.mass[p] * N[a];
        bound[f] += block.points.volume[p] * block.modulus * length[static_cast<std::size_t>(a)] * together;
        for (std::size_t i = 0; i < 2; ++i) momentum[2 * f + i] += block.points.mass[p] * N[a] * block.points.v[i][p];
      }
    }
  }
  REQUIRE(block.totals.mass().size() == functions);
  CHECK(largest_difference(block.totals.mass(), mass) < 1e-14);
  CHECK(largest_difference(block.totals.bound(), bound) < 1e-14 * largest_magnitude(bound));
  CHECK(largest_difference(block.totals.momentum(), momentum) < 1e-14);
  for (std::size_t f = 0; f < functions; ++f) CHECK(block.totals.reaches(f) == (bound[f] > 0));
}

TEMPLATE_LIST_TEST_CASE("points go where the weights say, and as fast", "", Cases) {
  using B = typename TestType::B;
  RandomBody<B, TestType::K> block;
  std::vector<double> u(2 * block.corner_sum.functions()), w(u.size());
  for (double& of_function : u) of_function = block.number(-1, 1);
  for (double& of_function : w) of_function = block.number(-1, 1);
  PointMotion<B, TestType::K> motion;
  std::vector<int> calls(block.points.cells(), 0);
  const double s = 0.3;
  motion.find(block.points, block.weights, u.data(), w.data(), s, [&](std::size_t k) { ++calls[k]; });
  Largest largest;
  for (std::size_t k = 0; k < block.points.cells(); ++k) {
    CHECK(calls[k] == 1);
    for (std::size_t p = block.points.begin(k); p < block.points.end(k); ++p) {
      const auto u_p = block.weights.value(u.data(), k, p), w_p = block.weights.value(w.data(), k, p);
      for (std::size_t i = 0; i < 2; ++i) {
        largest.take_magnitude(motion.x[i][p] - block.points.x[i][p] - u_p[i]);
        largest.take_magnitude(motion.v[i][p] - s * block.points.v[i][p] - w_p[i]);
      }
    }
  }
  CHECK(largest.value() < 1e-14);
}
