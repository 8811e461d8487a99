// The part of what a border bears that the grid's functions can tell.
#include "space/boundary/trace_fit.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

namespace stillpoint::test {
namespace {

using Piece = BorderPiece<Kinematics::plane>;
constexpr int cells_of_border = 8;

/// A border along x, in the middle of the cells of a linear basis, with two Gauss points a cell.
struct GaussBorder {
  std::vector<Piece> pieces;
  std::vector<double> x;  // of the pieces [cells]

  GaussBorder() {
    for (int cell = 0; cell < cells_of_border; ++cell) {
      for (const double s : {0.5 - 0.5 / std::numbers::sqrt3, 0.5 + 0.5 / std::numbers::sqrt3}) {
        x.push_back(cell + s);
        pieces.push_back(Piece::make({x.back(), 0.5}, 0.5, {0, 1}));
        auto& entries = pieces.back().at.entries;
        entries.clear();
        for (int row = 0; row < 2; ++row) {
          entries.push_back({.function = row * (cells_of_border + 1) + cell, .w = 0.5 * (1 - s), .dN = {}});
          entries.push_back({.function = row * (cells_of_border + 1) + cell + 1, .w = 0.5 * s, .dN = {}});
        }
      }
    }
  }
  /// The fit of the values at the pieces from … to, not included.
  template <class Value>
  Eigen::VectorXd fit(std::size_t from, std::size_t to, const Value& value) const {
    std::vector<std::size_t> touching;
    Eigen::MatrixXd borne(static_cast<Eigen::Index>(to - from), 1);
    for (std::size_t s = from; s < to; ++s) {
      touching.push_back(s);
      borne(static_cast<Eigen::Index>(s - from), 0) = value(s);
    }
    return TraceFit(std::span<const Piece>(pieces), touching)(borne).col(0);
  }
};

}  // namespace

TEST_CASE("a fit on a border keeps what is linear in each cell, as what goes to and fro from node to node") {
  const GaussBorder border;
  const auto zigzag = [&](std::size_t s) {
    const double in_cell = border.x[s] - std::floor(border.x[s]);
    return 3 + (static_cast<int>(border.x[s]) % 2 == 0 ? 1 : -1) * (1 - 2 * in_cell);
  };
  const Eigen::VectorXd all = border.fit(0, 2 * cells_of_border, zigzag), part = border.fit(4, 12, zigzag);
  for (std::size_t s = 0; s < 2 * cells_of_border; ++s)
    CHECK(all[static_cast<Eigen::Index>(s)] == Approx(zigzag(s)).epsilon(1e-9));
  for (std::size_t s = 4; s < 12; ++s) CHECK(part[static_cast<Eigen::Index>(s - 4)] == Approx(zigzag(s)).epsilon(1e-9));
}

TEST_CASE("a fit on a border leaves out what goes to and fro from cell to cell, where no node can tell it") {
  const GaussBorder border;
  // Of ±1 in the cells the nodes between two tell nothing, those at the ends a half or so of what is beside them.
  const Eigen::VectorXd fit = border.fit(
      0, 2 * cells_of_border, [&](std::size_t s) { return static_cast<int>(border.x[s]) % 2 == 0 ? 1.0 : -1.0; });
  for (std::size_t s = 6; s < 10; ++s) CHECK(std::abs(fit[static_cast<Eigen::Index>(s)]) < 0.15);
}

TEST_CASE("at the end of what touches a node that reaches a sliver of it is left to the one beside it") {
  const GaussBorder border;
  // The last piece is the near one of the cell from 5 to 6, which the node at 6 hardly reaches.
  const Eigen::VectorXd uniform = border.fit(4, 11, [](std::size_t) { return 2.0; });
  for (const double value : uniform) CHECK(value == Approx(2).epsilon(1e-9));
  const Eigen::VectorXd peak = border.fit(4, 11, [](std::size_t s) { return s == 10 ? 2.0 : 1.0; });
  CHECK(peak[6] > 1.2);
  CHECK(peak[6] < 1.8);
}

}  // namespace stillpoint::test
