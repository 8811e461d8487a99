#include "space/grid/basis.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "space/grid/spline_coefficient.hpp"

using namespace stillpoint;

namespace {

const Grid<1> uneven{{Axis{{0.0, 0.3, 1.0, 1.4, 2.5, 3.0}}}};

// Calls check(cell, x, values) at several places of every cell.
template <class Basis, class Check>
void everywhere(const Check& check) {
  const Axis& axis = uneven.axes[0];
  for (int cell = 0; cell < axis.cells(); ++cell) {
    for (const double s : {0.0, 0.17, 0.5, 0.83, 1.0}) {
      const double x = axis.nodes[cell] + s * (axis.nodes[cell + 1] - axis.nodes[cell]);
      check(cell, x, Basis::evaluate(uneven, {cell}, {x}));
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE("B-splines are a partition of unity and not negative", "", BSpline<1>, BSpline<2>, BSpline<3>) {
  using Basis = TensorBasis<TestType, 1>;
  everywhere<Basis>([](int, double, const auto& values) {
    double sum = 0, slope = 0;
    for (int a = 0; a < Basis::per_cell; ++a) {
      CHECK(values.N[a] >= -1e-15);
      sum += values.N[a];
      slope += values.dN[0][a];
    }
    CHECK(sum == Approx(1).epsilon(1e-14));
    CHECK(slope == Approx(0).margin(1e-13));
  });
}

TEMPLATE_TEST_CASE(
    "a spline with the coefficients of a polynomial up to its degree is that polynomial, on uneven cells", "",
    BSpline<1>, BSpline<2>, BSpline<3>) {
  using Basis = TensorBasis<TestType, 1>;
  const auto f = [](double x) { return std::pow(x - 1.2, TestType::degree) + 0.3 * x; };
  everywhere<Basis>([&](int cell, double x, const auto& values) {
    double sum = 0;
    for (int a = 0; a < Basis::per_cell; ++a) {
      const WeightedPositions of = spline_coefficient(uneven.axes[0], TestType::degree, TestType::first(cell) + a);
      for (std::size_t k = 0; k < of.x.size(); ++k) sum += values.N[a] * of.weight[k] * f(of.x[k]);
    }
    CHECK(sum == Approx(f(x)).margin(1e-13));
  });
}

TEMPLATE_TEST_CASE("gradients of a basis are the derivatives of its functions", "", BSpline<1>, BSpline<2>, BSpline<3>,
                   CubicHermite) {
  using Basis = TensorBasis<TestType, 1>;
  constexpr double d = 1e-6;
  everywhere<Basis>([](int cell, double x, const auto& values) {
    const auto above = Basis::evaluate(uneven, {cell}, {x + d}), below = Basis::evaluate(uneven, {cell}, {x - d});
    for (int a = 0; a < Basis::per_cell; ++a) {
      CHECK(values.dN[0][a] == Approx((above.N[a] - below.N[a]) / (2 * d)).margin(1e-8));  // O(d²) and rounding/d
    }
  });
}

TEMPLATE_TEST_CASE("cubic bases join with continuous slopes across an uneven grid", "", BSpline<3>, CubicHermite) {
  using Basis = TensorBasis<TestType, 1>;
  const Axis& axis = uneven.axes[0];
  for (int cell = 1; cell < axis.cells(); ++cell) {
    const double x = axis.nodes[cell];
    std::vector<double> left(Basis::count(uneven), 0.0), right(left);
    const auto before = Basis::evaluate(uneven, {cell - 1}, {x}), after = Basis::evaluate(uneven, {cell}, {x});
    for (int a = 0; a < Basis::per_cell; ++a) {
      left[Basis::first(uneven, {cell - 1}) + a] = before.dN[0][a];
      right[Basis::first(uneven, {cell}) + a] = after.dN[0][a];
    }
    for (std::size_t i = 0; i < left.size(); ++i) CHECK(left[i] == Approx(right[i]).margin(1e-12));
  }
}

TEST_CASE("splines interpolate only at the ends of the grid, hats and Hermite cubics at every node") {
  const auto interpolates = [](auto basis, double x) {
    return TensorBasis<decltype(basis), 1>::interpolating_function(uneven, {x}).has_value();
  };
  for (const double end : {0.0, 3.0}) {
    CHECK(interpolates(BSpline<1>{}, end));
    CHECK(interpolates(BSpline<2>{}, end));
    CHECK(interpolates(BSpline<3>{}, end));
    CHECK(interpolates(CubicHermite{}, end));
  }
  CHECK(interpolates(BSpline<1>{}, 1.4));
  CHECK(interpolates(CubicHermite{}, 1.4));
  CHECK_FALSE(interpolates(BSpline<2>{}, 1.4));
  CHECK_FALSE(interpolates(BSpline<3>{}, 1.4));
  CHECK_FALSE(interpolates(BSpline<1>{}, 1.5));
}

TEST_CASE("the tensor product in the plane is the product of the axis functions") {
  const Grid<2> grid{{Axis::uniform(0, 3, 3), Axis::uniform(0, 2, 2)}};
  using Plane = TensorBasis<BSpline<2>, 2>;
  const auto values = Plane::evaluate(grid, {1, 0}, {1.4, 0.3});
  double Nx[3], dNx[3], Ny[3], dNy[3];
  BSpline<2>::evaluate(grid.axes[0], 1, 1.4, Nx, dNx);
  BSpline<2>::evaluate(grid.axes[1], 0, 0.3, Ny, dNy);
  for (int a = 0; a < 9; ++a) {
    CHECK(values.N[a] == Approx(Nx[a % 3] * Ny[a / 3]));
    CHECK(values.dN[0][a] == Approx(dNx[a % 3] * Ny[a / 3]));
    CHECK(values.dN[1][a] == Approx(Nx[a % 3] * dNy[a / 3]));
  }
  CHECK(Plane::count(grid) == 5 * 4);
  CHECK(Plane::first(grid, {1, 1}) + Plane::offsets(grid)[4] == (1 + 1) * 5 + (1 + 1));
}

TEMPLATE_TEST_CASE(
    "in space a basis reproduces the coordinates, and its gradients are the derivatives of its functions", "",
    BSpline<1>, BSpline<2>, BSpline<3>, CubicHermite) {
  using Basis = TensorBasis<TestType, 3>;
  const Grid<3> grid{{Axis{{0, 0.3, 1, 1.4}}, Axis{{-1, 0, 0.25}}, Axis{{0, 3, 4, 4.5, 5}}}};
  constexpr double d = 1e-6;
  const auto offset = Basis::offsets(grid);
  for (int number = 0; number < grid.cells(); ++number) {
    const auto cell = grid.cell_at(number);
    Point<3> x;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto& lines = grid.axes[e].nodes;
      const auto c = static_cast<std::size_t>(cell[e]);
      x[e] = lines[c] + (0.2 + 0.3 * static_cast<double>(e)) * (lines[c + 1] - lines[c]);
    }
    const auto at = Basis::evaluate(grid, cell, x);
    if constexpr (TestType::partition_of_unity) {
      for (int e = 0; e < 3; ++e) {
        double sum = 0;
        for (int a = 0; a < Basis::per_cell; ++a) {
          const int function = Basis::first(grid, cell) + offset[a];
          sum += at.N[a] * TestType::centre(grid.axes[e], Basis::index_along(grid, function, e));
        }
        CHECK(sum == Approx(x[e]).margin(1e-13));
      }
    }
    for (std::size_t e = 0; e < 3; ++e) {
      Point<3> above = x, below = x;
      above[e] += d;
      below[e] -= d;
      const auto up = Basis::evaluate(grid, cell, above), down = Basis::evaluate(grid, cell, below);
      double worst = 0;
      for (int a = 0; a < Basis::per_cell; ++a)
        worst = std::max(worst, std::abs(at.dN[e][a] - (up.N[a] - down.N[a]) / (2 * d)));
      CHECK(worst < 1e-7);  // O(d²) and rounding/d
    }
  }
}
