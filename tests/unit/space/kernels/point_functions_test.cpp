// The functions of a grid and the weights of points as they are seen whatever the basis.
#include "space/kernels/point_functions.hpp"

#include <catch2/catch.hpp>

#include "space/grid/domain_basis.hpp"
#include "space/kernels/point_weights.hpp"

using namespace stillpoint;

namespace {

/// Two cells along each axis, of unequal width, a point in the first and one in the last.
template <int Dim>
struct Body {
  Grid<Dim> grid;
  MaterialPoints<Dim> points;

  Body() {
    for (Axis& axis : grid.axes) axis.nodes = {0.0, 1.0, 2.5};
    for (int d = 0; d < Dim; ++d) points.x[d] = {0.3 + 0.1 * d, 2.1 - 0.2 * d};
    points.volume = points.mass = {1.0, 1.0};
    points.cell = {0, grid.cells() - 1};
    points.cell_begin = {0, 1, 2};
    points.material_begin = {0, 2};
    points.number = {0, 1};
  }
};

template <AxisBasis B, Kinematics K>
void check_weights() {
  constexpr int dim = dimensions(K);
  const Body<dim> body;
  PointWeights<B, K> weights;
  weights.rebuild(body.grid, body.points);
  const PointFunctions<dim>& seen = weights;
  const FunctionsOfBasis<B, dim> functions(body.grid);
  REQUIRE(seen.functions_of_cell() == TensorBasis<B, dim>::per_cell);
  REQUIRE(functions.per_cell() == TensorBasis<B, dim>::per_cell);
  for (std::size_t p = 0; p < 2; ++p) {  // a cell each
    typename PointFunctions<dim>::Numbers N;
    typename PointFunctions<dim>::Slopes dN;
    seen.values(p, p, N);
    seen.slopes(p, p, dN);
    const auto at = functions.evaluate(/*field=*/0, seen.cell_at(p), body.points.position(p));
    for (int a = 0; a < functions.per_cell(); ++a) {
      CHECK(at.function[a] == seen.function(p, a));
      CHECK(N[a] == Approx(at.N[a]).margin(1e-14));
      for (int j = 0; j < dim; ++j) {
        const int i = functions.per_cell() * j + a;
        CHECK(dN[i] == Approx(at.dN[i]).margin(1e-14));
      }
    }
  }
}

}  // namespace

TEST_CASE("weights seen through the interface are the functions of the grid at the points, for every basis") {
  check_weights<BSpline<1>, Kinematics::line>();
  check_weights<CubicHermite, Kinematics::line>();
  check_weights<BSpline<1>, Kinematics::plane>();
  check_weights<BSpline<3>, Kinematics::plane>();
  check_weights<CubicHermite, Kinematics::plane>();
  check_weights<BSpline<2>, Kinematics::axisymmetric>();
  check_weights<BSpline<1>, Kinematics::space>();
  check_weights<BSpline<2>, Kinematics::space>();
}

TEST_CASE(
    "the functions on a face of a grid are those whose centre lies on it, and values among them leave out slopes") {
  const Body<2> body;
  const FunctionsOfBasis<BSpline<2>, 2> splines(body.grid);
  const FunctionsOfBasis<CubicHermite, 2> slopes(body.grid);
  const auto on_right = splines.on_face(0, true);
  CHECK(on_right == splines.values_on_face(0, true));
  CHECK(on_right.size() == 4);  // two cells and the degree
  for (const int function : on_right) CHECK(splines.centre(function, 0) == Approx(2.5));
  CHECK(slopes.on_face(1, false).size() == 6);  // a value and a slope at each of three nodes
  CHECK(slopes.values_on_face(1, false).size() == 3);
  for (const int function : slopes.on_face(1, false)) CHECK(slopes.centre(function, 1) == Approx(0).margin(1e-15));
}

TEST_CASE("a value is carried by one function alone at a corner of a grid of splines, and at every node of Hermite's") {
  const Body<2> body;
  const FunctionsOfBasis<BSpline<2>, 2> splines(body.grid);
  const FunctionsOfBasis<CubicHermite, 2> hermite(body.grid);
  REQUIRE(splines.interpolating({2.5, 2.5}).has_value());
  CHECK(splines.centre(*splines.interpolating({2.5, 2.5}), 0) == Approx(2.5));
  CHECK_FALSE(splines.interpolating({1.0, 1.0}).has_value());
  REQUIRE(hermite.interpolating({1.0, 1.0}).has_value());
  CHECK(hermite.is_value(*hermite.interpolating({1.0, 1.0})));
}
