// The grid's functions fitted to values at material points.
#include "space/kernels/point_fit.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "largest.hpp"

using namespace stillpoint;

namespace {

constexpr auto plane = Kinematics::plane;

/// Points of a box [0, 2.3] × [0, 1] in a grid of 3 × 2 cells, two along each coordinate, whose last column reaches
/// functions by next to nothing.
template <AxisBasis B>
struct Points {
  Grid<2> grid;
  MaterialPoints<2> points;
  PointWeights<B, plane> weights;
  CornerSum corner_sum;
  PointValues<1, 2> values;

  /// lines: of the columns of cells, in which the points keep their places.
  explicit Points(double last_x, const std::vector<double>& lines = {0, 1, 2, 3}) {
    grid.axes = {Axis{lines, /*is_even=*/false}, Axis::uniform(0, 2, 2)};
    std::vector<double> xs = {0.25, 0.75, 1.25, 1.75, last_x}, ys = {0.25, 0.75, 1.25, 1.75};
    for (double& x : xs) {
      const auto c = static_cast<std::size_t>(x);
      x = lines[c] + (x - static_cast<double>(c)) * (lines[c + 1] - lines[c]);
    }
    for (int c = 0; c < grid.cells(); ++c) {
      const std::size_t before = points.volume.size();
      for (const double y : ys) {
        for (const double x : xs) {
          if (grid.cell_number(grid.cell_of({x, y})) != c) continue;
          points.x[0].push_back(x);
          points.x[1].push_back(y);
          points.volume.push_back(0.25);
          points.mass.push_back(1);
        }
      }
      if (points.volume.size() == before) continue;
      points.cell.push_back(c);
      points.cell_begin.push_back(static_cast<int>(before));
    }
    points.cell_begin.push_back(static_cast<int>(points.volume.size()));
    points.material_begin = {0, static_cast<int>(points.volume.size())};
    weights.rebuild(grid, points);
    std::vector<int> functions;
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (int a = 0; a < PointWeights<B, plane>::per_cell; ++a) functions.push_back(weights.function(k, a));
    }
    corner_sum.rebuild(functions, static_cast<std::size_t>(TensorBasis<B, 2>::count(grid)));
  }
  template <class Field>
  void set(const Field& field) {
    values = {};
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto [value, dx, dy] = field(points.x[0][p], points.x[1][p]);
      values.value.push_back({value});
      values.gradient.push_back({dx, dy});
    }
    values.mass = points.mass;
  }
  /// Largest difference of the fit's gradient to the field's, in the points.
  template <class Field>
  double gradient_error(const Field& field, const PointFitOptions& options) {
    set(field);
    const PointFit<1, B, plane> fit(grid, points, weights, corner_sum, values, options);
    const std::vector<double> z = fit.solve({});
    Largest off;
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        double dx = 0, dy = 0;
        for (int a = 0; a < PointWeights<B, plane>::per_cell; ++a) {
          dx += weights.dN(k, p)[a] * z[static_cast<std::size_t>(weights.function(k, a))];
          dy += weights.dN(k, p)[PointWeights<B, plane>::per_cell + a] *
                z[static_cast<std::size_t>(weights.function(k, a))];
        }
        off.take_magnitude(dx - values.gradient[p][0]);
        off.take_magnitude(dy - values.gradient[p][1]);
      }
    }
    return off.value();
  }
};

constexpr auto linear = [](double x, double y) { return std::array{3 + 2 * x - 5 * y, 2.0, -5.0}; };
constexpr auto parabola = [](double x, double y) { return std::array{x * x - x * y, 2 * x - y, -x}; };

}  // namespace

TEST_CASE("gradients count in a fit by the lengths of the cells they are in: cells of other lengths change nothing") {
  const auto fitted = [](const std::vector<double>& lines) {
    Points<BSpline<1>> at(2.2, lines);
    at.set([](double, double) { return std::array{0.0, 0.0, 0.0}; });
    for (std::size_t p = 0; p < at.points.size(); ++p) at.values.value[p][0] = std::sin(2.0 * static_cast<double>(p));
    return PointFit<1, BSpline<1>, plane>(at.grid, at.points, at.weights, at.corner_sum, at.values,
                                          {.tolerance = 1e-14, .iterations = 100})
        .solve({});
  };
  const std::vector<double> equal = fitted({0, 1, 2, 3}), unequal = fitted({0, 1, 1.05, 4});
  REQUIRE(equal.size() == unequal.size());
  for (std::size_t k = 0; k < equal.size(); ++k) CHECK(unequal[k] == Approx(equal[k]).margin(1e-11));
}

TEST_CASE("a fit to points starts with what is linear in x, so that no iteration is left of it") {
  CHECK(Points<BSpline<1>>(2.2).gradient_error(linear, {.iterations = 0}) < 1e-13);
  CHECK(Points<BSpline<2>>(2.2).gradient_error(linear, {.iterations = 0}) < 1e-13);
  CHECK(Points<BSpline<3>>(2.2).gradient_error(linear, {.iterations = 0}) < 1e-12);
}

TEST_CASE("a fit to points of a parabola is a parabola, however little a function is reached") {
  for (const double last_x : {2.2, 2.01, 2.0001, 2 + 1e-9}) {
    CAPTURE(last_x);
    CHECK(Points<BSpline<2>>(last_x).gradient_error(parabola, {.tolerance = 1e-12, .iterations = 200}) < 1e-8);
    CHECK(Points<BSpline<3>>(last_x).gradient_error(parabola, {.tolerance = 1e-12, .iterations = 400}) < 1e-8);
  }
}
