// The mean over neighbouring patches by which multipliers of contact change.
#include "space/boundary/patch_neighbours.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

namespace stillpoint::test {
namespace {

constexpr Kinematics K = Kinematics::plane;

/// A straight border along x of a piece in each of these cells [m].
struct Border {
  std::vector<BorderPiece<K>> pieces;
  std::vector<SurfacePatch> patches;
  PatchNeighbours neighbours;

  explicit Border(const std::vector<double>& cells) {
    double x = 0;
    for (const double cell : cells) {
      pieces.push_back(BorderPiece<K>::make({x + cell / 2, 0}, cell, {0, 1}));
      patches.push_back({.begin = pieces.size() - 1, .end = pieces.size(), .cell = cell});
      x += cell;
    }
    neighbours.find<K>(patches, pieces, {});
  }
  std::vector<double> smoothed(const std::vector<double>& values, const std::vector<char>& counts) const {
    std::vector<double> means(values.size(), 0);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (counts[k]) means[k] = neighbours.smoothed(k, values, counts);
    return means;
  }
};

}  // namespace

TEST_CASE("a mean over neighbouring patches has nothing of what alternates, at the ends of what is touched either") {
  const Border border(std::vector<double>(12, 0.1));
  std::vector<double> alternating, even(12, 3);
  for (int k = 0; k < 12; ++k) alternating.push_back(k % 2 == 0 ? 1 : -1);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 12}, {3, 9}, {4, 6}}) {
    CAPTURE(from, to);
    std::vector<char> counts(12, 0);
    for (std::size_t k = from; k < to; ++k) counts[k] = 1;
    const auto of_alternating = border.smoothed(alternating, counts), of_even = border.smoothed(even, counts);
    for (std::size_t k = from; k < to; ++k) {
      CHECK(std::abs(of_alternating[k]) <= 1e-14);
      CHECK(of_even[k] == Approx(3).epsilon(1e-14));
    }
  }
  std::vector<char> alone(12, 0);
  alone[5] = 1;
  CHECK(border.smoothed(alternating, alone)[5] == alternating[5]);
}

TEST_CASE(
    "repeated means over neighbours of any sizes die out but for what is even: no eigenvalue is below 0 or above 1") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(0, 3.5);
  for (int border = 0; border < 20; ++border) {
    std::vector<double> cells;
    for (int k = 0; k < 16; ++k) cells.push_back(0.1 * std::exp2(exponent(random)));  // up to 11 : 1
    const Border of(cells);
    Eigen::MatrixXd S(16, 16);
    for (int j = 0; j < 16; ++j) {
      std::vector<double> unit(16, 0);
      unit[static_cast<std::size_t>(j)] = 1;
      const auto column = of.smoothed(unit, std::vector<char>(16, 1));
      for (int i = 0; i < 16; ++i) S(i, j) = column[static_cast<std::size_t>(i)];
    }
    for (const auto& value : S.eigenvalues()) {
      CHECK(std::abs(value.imag()) <= 1e-10);
      CHECK(value.real() >= -1e-10);
      CHECK(value.real() <= 1 + 1e-10);
    }
  }
}

}  // namespace stillpoint::test
