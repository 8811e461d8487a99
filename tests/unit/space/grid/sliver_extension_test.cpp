#include "space/grid/sliver_extension.hpp"

#include <cmath>
#include <vector>

#include <Eigen/QR>
#include <catch2/catch.hpp>

#include "space/grid/degrees_of_freedom.hpp"

using namespace stillpoint;

namespace {

using Sources = std::vector<ExtendedFunctions::Source>;
const auto may_follow = [](int, const Sources&) { return true; };

// Cells 0 to 4 of nine are whole, and `share` of the next one is covered.
CellShares five_cells_and(double share) { return {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, share}}; }

template <class B>
std::vector<double> weights_beside_a_sliver() {
  const Grid<1> line{{Axis::uniform(0, 9, 9)}};
  const std::vector<CellShares> covered = {five_cells_and(0.1)};
  const CutCells<1> cut(line, covered, B::degree);
  const SliverExtension<B, 1> extension(line, cut, may_follow);
  REQUIRE(extension.slivers() == 1);
  REQUIRE(extension.joined() == 1);
  REQUIRE(extension.functions().functions() == std::vector<int>{B::first(5) + B::degree});
  std::vector<double> weights;
  for (const auto& [function, weight] : extension.functions().sources(0)) weights.push_back(weight);
  return weights;
}

void check_close(const std::vector<double>& found, const std::vector<double>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) CHECK(std::abs(found[k] - expected[k]) < 1e-11);  // of rounding
}

// A corner of a body that ends askew in the grid, whose cells have different sizes.
const Grid<2> uneven_plane{{Axis{{0, 1, 1.8, 3, 3.7, 5, 6}}, Axis{{0, 0.6, 1.7, 2.5, 3.6, 4.2}}}};
CellShares corner() {
  CellShares shares;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      const double reach = std::min(x == 4 ? 0.2 : 1.0, y == 3 ? 0.1 : 1.0) - (x == 4 && y == 3 ? 0.08 : 0);
      shares.emplace_back(uneven_plane.cell_number({x, y}), reach);
    }
  }
  return shares;
}

// Coefficients of a field that the basis holds: the least squares fit at many positions of each cell.
template <class B, class Field>
std::vector<double> coefficients(const Field& field) {
  using Basis = TensorBasis<B, 2>;
  constexpr int along = B::per_cell;
  const auto offset = Basis::offsets(uneven_plane);
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(uneven_plane.cells() * along * along, Basis::count(uneven_plane));
  Eigen::VectorXd q(N.rows());
  int row = 0;
  for (int cell = 0; cell < uneven_plane.cells(); ++cell) {
    const auto at = uneven_plane.cell_at(cell);
    for (int k = 0; k < along * along; ++k, ++row) {
      Point<2> x;
      for (int d = 0; d < 2; ++d) {
        const double left = uneven_plane.axes[d].nodes[at[d]], right = uneven_plane.axes[d].nodes[at[d] + 1];
        x[d] = left + (right - left) * ((d == 0 ? k % along : k / along) + 0.5) / along;
      }
      const auto values = Basis::evaluate(uneven_plane, at, x);
      for (int a = 0; a < Basis::per_cell; ++a) N(row, Basis::first(uneven_plane, at) + offset[a]) = values.N[a];
      q(row) = field(x);
    }
  }
  const Eigen::VectorXd u = N.colPivHouseholderQr().solve(q);
  REQUIRE((N * u - q).lpNorm<Eigen::Infinity>() < 1e-11 * q.lpNorm<Eigen::Infinity>());
  return {u.begin(), u.end()};
}

template <class B>
void check_that_polynomials_are_kept() {
  const std::vector<CellShares> covered = {corner()};
  const CutCells<2> cut(uneven_plane, covered, B::degree);
  const SliverExtension<B, 2> extension(uneven_plane, cut, may_follow);
  REQUIRE_FALSE(extension.functions().empty());
  CHECK(extension.joined() == extension.slivers());
  const auto u = coefficients<B>([](const Point<2>& x) {
    return std::pow(x[0] - 2, B::degree) * std::pow(x[1] - 1, B::degree) + x[0] - 3 * x[1];
  });
  const ExtendedFunctions& functions = extension.functions();
  for (std::size_t e = 0; e < functions.functions().size(); ++e) {
    double sum = 0, size = 1;
    for (const auto& [function, weight] : functions.sources(e)) {
      sum += weight * u[static_cast<std::size_t>(function)];
      size += std::abs(weight * u[static_cast<std::size_t>(function)]);
    }
    CHECK(std::abs(sum - u[static_cast<std::size_t>(functions.functions()[e])]) < 1e-10 * size);
  }
}

}  // namespace

TEST_CASE("the outermost function of a sliver goes on as the polynomial of the cell beside it, by binomials") {
  check_close(weights_beside_a_sliver<BSpline<1>>(), {-1, 2});
  check_close(weights_beside_a_sliver<BSpline<2>>(), {1, -3, 3});
  check_close(weights_beside_a_sliver<BSpline<3>>(), {-1, 4, -6, 4});
}

TEST_CASE("extended coefficients are those of every polynomial of the basis, on a grid of uneven cells in the plane") {
  check_that_polynomials_are_kept<BSpline<1>>();
  check_that_polynomials_are_kept<BSpline<2>>();
  check_that_polynomials_are_kept<BSpline<3>>();
  check_that_polynomials_are_kept<CubicHermite>();
}

TEST_CASE("functions that a well-filled cell has too stay as they are, and so do those of a bridge") {
  const Grid<1> line{{Axis::uniform(0, 9, 9)}};
  const std::vector<CellShares> filled = {five_cells_and(0.7)}, bridge = {{{0, 1}, {1, 1}, {2, 0.1}, {3, 0.1}, {4, 1}}};
  for (const auto& covered : {filled, bridge}) {
    const CutCells<1> cut(line, covered, 1);
    const SliverExtension<BSpline<1>, 1> extension(line, cut, may_follow);
    CHECK(extension.functions().empty());
    CHECK(extension.joined() == 0);
  }
}

TEST_CASE("a function that may follow nothing stays an unknown, and its cell is told as not joined") {
  const Grid<1> line{{Axis::uniform(0, 9, 9)}};
  const std::vector<CellShares> covered = {five_cells_and(0.1)};
  const CutCells<1> cut(line, covered, 2);
  const SliverExtension<BSpline<2>, 1> extension(line, cut, [](int, const Sources&) { return false; });
  CHECK(extension.functions().empty());
  CHECK(extension.slivers() == 1);
  CHECK(extension.joined() == 0);
}

TEST_CASE("extended unknowns are numbered behind all others, and those that a support prescribes are its own") {
  ExtendedFunctions extension(5);
  extension.add(3, {{1, -1.0}, {2, 2.0}});
  // Components 0 and 1 of functions 0 … 4, of which no material reaches the last.
  const DegreesOfFreedom dofs({1, 1, 1, 1, 0}, 2, {0, 7}, extension);
  CHECK(dofs.free == std::vector<int>{1, 2, 3, 4, 5});
  CHECK(dofs.extended == std::vector<int>{6});
  CHECK(dofs.number == std::vector<int>{5, 0, 1, 2, 3, 4, 7, 6, -1, -1});
  CHECK(dofs.is_extended(dofs.number[6]));
  CHECK_FALSE(dofs.is_extended(dofs.number[7]));
}

TEST_CASE("forces at extended unknowns do the same work at those that they follow") {
  ExtendedFunctions extension(4);
  extension.add(2, {{0, 3.0}, {1, -2.0}});
  extension.add(3, {{0, 0.25}, {1, 0.75}});
  const DegreesOfFreedom dofs({1, 1, 1, 1}, 1, {0}, extension);
  std::vector<double> u = {0.7, -0.3, 0, 0};
  dofs.extend(u.data());
  CHECK(u[2] == Approx(3 * 0.7 + 2 * 0.3));
  CHECK(u[3] == Approx(0.25 * 0.7 - 0.75 * 0.3));
  const std::vector<double> F = {1.5, -4.0};
  double work = 0, at_sources = 0;
  for (std::size_t e = 0; e < 2; ++e) work += F[e] * u[2 + e];
  dofs.give_to_sources(F, [&](int dof, double force) { at_sources += force * (dof == 0 ? u[1] : u[0]); });
  CHECK(at_sources == Approx(work));
}
