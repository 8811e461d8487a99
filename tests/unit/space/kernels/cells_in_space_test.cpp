// Gather and scatter in cells of space, against the basis itself, and forces of a block of points.
#include <cmath>
#include <random>
#include <vector>

#include <catch2/catch.hpp>
#include <omp.h>

#include "largest.hpp"
#include "points_in_space.hpp"
#include "random_values.hpp"

using namespace stillpoint;

namespace {

using SpaceBlock = PointBlock<Kinematics::space>;

/// Uneven sides; from no point to eleven in a cell, anywhere in it.
template <AxisBasis B>
struct Scattered {
  using Weights = PointWeights<B, Kinematics::space>;
  using Basis = TensorBasis<B, 3>;
  Grid<3> grid{{Axis{{0, 0.5, 2}}, Axis{{-1, 0, 0.25, 1}}, Axis{{0, 3, 4}}}};
  MaterialPoints<3> points;
  Weights weights;
  std::vector<double> u, before;

  Scattered() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    points = test::points_in_cells(
        grid, [](int cell) { return cell % 12; }, [&](int, int) { return uniform(random); });
    weights.rebuild(grid, points);
    u = test::random_values(3 * static_cast<std::size_t>(Basis::count(grid)), 1, 1);
    before = test::random_values(u.size(), 1, 2);
  }
  auto values(std::size_t k, std::size_t p) const {
    return Basis::evaluate(grid, weights.cell_at(k), points.position(p));
  }
};

}  // namespace

TEMPLATE_TEST_CASE("weights in space, made from positions or from factors, are those of the basis", "", BSpline<1>,
                   BSpline<2>, BSpline<3>) {
  const Scattered<TestType> s;
  REQUIRE(s.points.size() > 50);
  for (std::size_t k = 0; k < s.points.cells(); ++k) {
    for (std::size_t p = s.points.begin(k); p < s.points.end(k); ++p) {
      const auto values = s.values(k, p);
      const auto N = s.weights.N(k, p);
      const auto dN = s.weights.dN(k, p);
      constexpr int n = Scattered<TestType>::Basis::per_cell;
      for (int a = 0; a < n; ++a) {
        CHECK(std::abs(N[a] - values.N[a]) <= 1e-15);
        for (int j = 0; j < 3; ++j) CHECK(std::abs(dN[n * j + a] - values.dN[j][a]) <= 1e-14);
      }
    }
  }
}

TEMPLATE_TEST_CASE("gathering in space gives the gradients of the displacement and of its increment, cell by cell", "",
                   BSpline<1>, BSpline<2>, BSpline<3>) {
  using Cells = GatherScatter<TestType, Kinematics::space>;
  const Scattered<TestType> s;
  SpaceBlock block;
  std::vector<double> increment = s.u;
  for (std::size_t i = 0; i < increment.size(); ++i) increment[i] -= s.before[i];
  for (std::size_t k = 0; k < s.points.cells(); ++k) {
    block.first = s.points.begin(k);
    Cells::template gather<true>(s.weights, k, s.points.begin(k), s.points.end(k), s.u.data(), s.before.data(),
                                 block.first, block.H, block.dH);
    for (std::size_t p = s.points.begin(k); p < s.points.end(k); ++p) {
      CHECK(largest_difference(block.H_at(p - block.first), s.weights.gradient(s.u.data(), k, p)) <= 1e-13);
      CHECK(largest_difference(block.dH_at(p - block.first), s.weights.gradient(increment.data(), k, p)) <= 1e-13);
    }
  }
}

TEMPLATE_TEST_CASE("scattering in space gives each function the stresses of the points times the gradients there", "",
                   BSpline<1>, BSpline<2>, BSpline<3>) {
  using Cells = GatherScatter<TestType, Kinematics::space>;
  constexpr std::size_t functions = Scattered<TestType>::Basis::per_cell;
  const Scattered<TestType> s;
  SpaceBlock block;
  for (std::size_t k = 0; k < s.points.cells(); ++k) {
    block.first = s.points.begin(k);
    const auto P = test::random_values(9 * (s.points.end(k) - s.points.begin(k)), 1, static_cast<unsigned>(k));
    for (std::size_t i = 0; i < P.size(); ++i) block.VP[i % 9][i / 9] = P[i];
    std::array<double, 3 * functions> corner, expected{};
    for (std::size_t p = s.points.begin(k); p < s.points.end(k); ++p) {
      const auto values = s.values(k, p);
      for (std::size_t a = 0; a < functions; ++a)
        for (std::size_t ij = 0; ij < 9; ++ij)
          expected[3 * a + ij / 3] += block.VP[ij][p - block.first] * values.dN[ij % 3][a];
    }
    Cells::scatter(s.weights, k, s.points.begin(k), s.points.end(k), block, corner.data());
    CHECK(largest_difference(corner, expected) <= 1e-13 * (1 + largest_magnitude(expected)));
  }
}

TEST_CASE("a block of points under one stress pushes on its border alone, with the stress times the area") {
  test::CubeOfCells<> cube(6);
  const auto answer = [&](std::size_t, SpaceBlock& block) {
    double bad = 0;
    for (std::size_t q = 0; q < block.count; ++q)
      bad += block.store_stress(q, cube.points.volume[block.first + q], {2, 0, 0, 0, 3, 0, 0, 0, 5});
    return bad;
  };
  const std::vector<double> u(cube.dofs.size(), 0.0);
  std::vector<double> R(cube.dofs.size());
  REQUIRE(cube.force.evaluate<false>(u.data(), nullptr, answer, cube.dofs, R, {}, cube.work));
  for (int face = 0; face < 3; ++face) {
    double sum = 0;
    for (const int function : test::CubeOfCells<>::Basis::face_functions(cube.grid, face, true))
      sum += R[static_cast<std::size_t>(3 * function + face)];
    CHECK(sum == Approx(face == 0 ? 2 : face == 1 ? 3 : 5).epsilon(1e-13));
  }
  double inside = 0;
  for (int number = 0; number < test::CubeOfCells<>::Basis::count(cube.grid); ++number) {
    bool border = false;
    for (int d = 0; d < 3; ++d) {
      const int along = test::CubeOfCells<>::Basis::index_along(cube.grid, number, d);
      border = border || along == 0 || along == 6;
    }
    for (int i = 0; i < 3 && !border; ++i)
      inside = std::max(inside, std::abs(R[static_cast<std::size_t>(3 * number + i)]));
  }
  CHECK(inside <= 1e-15);
}

TEST_CASE("forces of trilinear cells are the same bits for 1, 2 and 3 threads") {
  test::CubeOfCells<> cube(12);  // more points than one thread takes
  const auto answer = [&](std::size_t, SpaceBlock& block) {
    double bad = 0;
    for (std::size_t q = 0; q < block.count; ++q)
      bad += block.store_stress(q, cube.points.volume[block.first + q], block.H_at(q));
    return bad;
  };
  const auto u = test::random_values(cube.dofs.size(), 1, 4);
  const int threads_before = omp_get_max_threads();
  std::vector<std::vector<double>> R(3, std::vector<double>(cube.dofs.size()));
  for (int threads = 1; threads <= 3; ++threads) {
    omp_set_num_threads(threads);
    REQUIRE(cube.force.evaluate<false>(u.data(), nullptr, answer, cube.dofs, R[static_cast<std::size_t>(threads - 1)],
                                       {}, cube.work));
  }
  omp_set_num_threads(threads_before);
  CHECK(largest_magnitude(R[0]) > 1e-3);
  CHECK(R[0] == R[1]);
  CHECK(R[0] == R[2]);
}
