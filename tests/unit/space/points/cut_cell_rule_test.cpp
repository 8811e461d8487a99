#include "space/points/cut_cell_rule.hpp"

#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

#include "largest.hpp"

using namespace stillpoint;

namespace {

/// Parts of the unit square: halves askew, a corner, a notch, two arms, slivers.
const std::vector<Polygon> kParts = {
    {{0, 0}, {0.7, 0}, {0.2, 1}, {0, 1}},
    {{0, 0}, {0.4, 0}, {0, 0.3}},
    {{0.6, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0.45}},
    {{0, 0}, {1, 0}, {0.4, 0.4}, {1, 1}, {0, 1}},
    clipped_to_unit_square(
        {{-2, 0.1}, {0.8, 0.1}, {0.8, 0.3}, {-1, 0.3}, {-1, 0.6}, {0.5, 0.6}, {0.5, 0.9}, {-2, 0.9}}),
    {{0, 0}, {1e-3, 0}, {2e-3, 1}, {0, 1}},
    {{0, 0.1}, {1, 0.7}, {1, 0.7001}, {0, 0.1001}},
};

/// The largest error among means of x^a y^b of this total degree.
double error_of_degree(const CutCellRule& cut, const Polygon& part, int degree) {
  const PlaneRule exact = polygon_rule(part, degree);
  Largest error;
  for (int a = 0; a <= degree; ++a) {
    const auto mean = [&](const PlaneRule& rule) {
      double sum = 0;
      for (std::size_t q = 0; q < rule.x.size(); ++q)
        sum += rule.share[q] * std::pow(rule.x[q][0], a) * std::pow(rule.x[q][1], degree - a);
      return sum;
    };
    error.take_magnitude(mean(cut.points) - mean(exact));
  }
  return error.value();
}

/// The highest total degree up to which all means are right.
int observed_degree(const CutCellRule& cut, const Polygon& part) {
  int degree = 0;
  while (degree < highest_cut_cell_degree && error_of_degree(cut, part, degree + 1) < 1e-10) ++degree;
  return degree;
}

void check_shares(const CutCellRule& cut, const Polygon& part) {
  double sum = 0;
  for (std::size_t p = 0; p < cut.points.x.size(); ++p) {
    CHECK(cut.points.share[p] > 0);
    CHECK(contains(part, cut.points.x[p]));
    sum += cut.points.share[p];
  }
  CHECK(sum == Approx(1).epsilon(1e-11));
}

std::vector<PlanePoint> pattern_inside(const Polygon& part, int n) {
  std::vector<PlanePoint> inside;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const PlanePoint x{(i + 0.5) / n, (j + 0.5) / n};
      if (contains(part, x)) inside.push_back(x);
    }
  }
  return inside;
}

}  // namespace

TEST_CASE("fitted shares of a cut cell are not negative, sum to one and integrate what they say") {
  int fitted_higher = 0;
  for (const Polygon& part : kParts) {
    for (const int n : {2, 3, 4, 6}) {
      const std::vector<PlanePoint> inside = pattern_inside(part, n);
      if (inside.empty()) continue;
      const CutCellRule cut = fitted_shares(part, inside), equal = equal_shares(part, inside);
      CAPTURE(part, n, cut.degree);
      check_shares(cut, part);
      check_shares(equal, part);
      CHECK(cut.degree == observed_degree(cut, part));
      CHECK(equal.degree == observed_degree(equal, part));
      CHECK(cut.degree >= equal.degree);
      fitted_higher += cut.degree > equal.degree ? 1 : 0;
    }
  }
  CHECK(fitted_higher >= 8);  // the claim is about fits
}

TEST_CASE("shares that need no fit stay equal") {
  // A half whose points are symmetric in it.
  const Polygon half = {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}};
  const CutCellRule cut = fitted_shares(half, {{0.25, 0.25}, {0.25, 0.75}});
  CHECK(cut.points.share[0] == Approx(0.5).epsilon(1e-13));
  CHECK(cut.degree == 1);
}

TEST_CASE(
    "Gauss points of a cut cell lie inside, have positive shares and integrate degree 1, 2, 4 by 4, 9, 16 points") {
  const std::vector<std::pair<std::size_t, int>> expected = {{1, 0}, {4, 1}, {9, 2}, {16, 4}, {25, 5}, {36, 7}};
  for (const Polygon& part : kParts) {
    for (const auto& [most, degree] : expected) {
      const CutCellRule cut = gauss_points(part, most);
      CAPTURE(part, most, cut.degree);
      check_shares(cut, part);
      CHECK(cut.points.x.size() <= most);
      CHECK(cut.degree >= degree);
      CHECK(observed_degree(cut, part) >= cut.degree);
    }
  }
}

TEST_CASE("random cuts of a cell give Gauss points as good as regular ones") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5);
  int cut_cells = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Polygon triangle(3);
    for (PlanePoint& corner : triangle) corner = {coordinate(random), coordinate(random)};
    const Polygon part = clipped_to_unit_square(triangle);
    if (std::abs(signed_area(part)) < 1e-6) continue;
    ++cut_cells;
    const CutCellRule cut = gauss_points(part, 16);
    CAPTURE(triangle, cut.degree);
    CHECK(cut.degree >= 4);
    CHECK(observed_degree(cut, part) >= cut.degree);
    CHECK(cut.points.x.size() <= 16);
  }
  CHECK(cut_cells > 300);
}
