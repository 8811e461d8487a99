// The lines of a grid, given by min, max and cells or piece by piece, and the lengths and positions between them.
#include "scene/grid_lines.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "scene/grid_fault.hpp"
#include "space/grid/scene_grid.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinAbs;

namespace {

GridSpec equal_cells(double min, double max, int cells) {
  return {.min = {min}, .max = {max}, .cells = {cells}, .follow = ""};
}

GridSpec by_pieces(std::vector<GridPiece> pieces) {
  GridSpec grid;
  grid.pieces[0] = std::move(pieces);
  take_extent_of_pieces(grid);
  return grid;
}

/// Three pieces: cells of 0.5, cells that grow by a factor of 2 each, and a single cell.
GridSpec three_pieces() { return by_pieces({{-1, 1, 4}, {1, 8, 3, 4}, {8, 9.5, 1}}); }

std::vector<double> lengths_of(const GridSpec& grid) {
  const std::vector<double> lines = grid_lines(grid, 0);
  std::vector<double> lengths;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k) lengths.push_back(lines[k + 1] - lines[k]);
  return lengths;
}

}  // namespace

TEST_CASE("equal cells have the lines of an even axis to the bit, by min, max and cells or by one piece") {
  for (const auto& [min, max, cells] : {std::tuple{0.1, 0.7, 7}, {-1.0 / 3, 2.9, 1013}, {1e6, 1e6 + 0.3, 3}}) {
    const GridSpec plain = equal_cells(min, max, cells), piece = by_pieces({{min, max, cells}});
    const std::vector<double> lines = Axis::uniform(min, max, cells).nodes;
    CHECK(grid_lines(plain, 0) == lines);
    CHECK(grid_lines(piece, 0) == lines);
    for (const GridSpec& grid : {plain, piece}) {
      const double h = (max - min) / cells, x = min + 0.37 * (max - min);
      CHECK(has_equal_cells(grid, 0));
      for (const double length :
           {smallest_cell(grid, 0), longest_cell(grid, 0), mean_cell(grid, 0), cell_length_at(grid, 0, x),
            longest_cell(grid), longest_mean_cell(grid), longest_of_smallest_sides(grid)})
        CHECK(length == h);
      CHECK(cells_before(grid, 0, x) == (x - min) / h);
      CHECK(cells_between(grid, 0, min, x) == (x - min) / h);
    }
  }
}

TEST_CASE("the cells of a piece are in geometric progression, the last as many times the first as its ratio says") {
  const std::vector<double> lines = grid_lines(three_pieces(), 0);
  const std::vector<double> expected = {-1, -0.5, 0, 0.5, 1, 2, 4, 8, 9.5};
  REQUIRE(lines.size() == expected.size());
  for (std::size_t k = 0; k < lines.size(); ++k) CHECK_THAT(lines[k], WithinAbs(expected[k], 1e-14));
  CHECK(lines[4] == 1);  // the ends of pieces are exact
  CHECK(lines[7] == 8);
  for (const double ratio : {0.05, 0.999999999, 1.0, 1.0000001, 3.0, 400.0}) {
    const int cells = 23;
    const std::vector<double> lengths = lengths_of(by_pieces({{0.3, 7, cells, ratio}}));
    CAPTURE(ratio);
    CHECK(lengths.back() / lengths.front() == Approx(ratio).epsilon(1e-11));
    const double q = std::pow(ratio, 1.0 / (cells - 1));
    for (std::size_t k = 0; k + 1 < lengths.size(); ++k) CHECK(lengths[k + 1] / lengths[k] == Approx(q).epsilon(1e-11));
  }
}

TEST_CASE("the smallest, longest and mean length of cells are those between the lines, and at x that of its cell") {
  for (const GridSpec& grid : {three_pieces(), by_pieces({{0, 1, 5, 0.2}, {1, 1.5, 4, 7}}), equal_cells(2, 3, 9)}) {
    const std::vector<double> lines = grid_lines(grid, 0), lengths = lengths_of(grid);
    CHECK_THAT(smallest_cell(grid, 0), WithinAbs(std::ranges::min(lengths), 1e-15));
    CHECK_THAT(longest_cell(grid, 0), WithinAbs(std::ranges::max(lengths), 1e-15));
    CHECK(mean_cell(grid, 0) == (lines.back() - lines.front()) / static_cast<double>(lengths.size()));
    for (std::size_t k = 0; k < lengths.size(); ++k)
      CHECK_THAT(cell_length_at(grid, 0, lines[k] + 0.3 * lengths[k]), WithinAbs(lengths[k], 1e-15));
  }
}

TEST_CASE("positions are counted in cells, each of which counts as one however long it is") {
  for (const GridSpec& grid : {three_pieces(), by_pieces({{0, 1, 5, 0.2}, {1, 1.5, 4, 7}})}) {
    const std::vector<double> lines = grid_lines(grid, 0), lengths = lengths_of(grid);
    for (std::size_t k = 0; k < lengths.size(); ++k) {
      const auto cell = static_cast<double>(k);
      CAPTURE(cell);
      for (const double share : {0.0, 0.2, 0.49, 0.51, 0.9}) {
        const double x = lines[k] + share * lengths[k];
        CHECK(cell_at(grid, 0, x) == static_cast<int>(k));
        CHECK(nearest_line(grid, 0, x) == static_cast<int>(k) + (share > 0.5 ? 1 : 0));
        CHECK(is_on_line(grid, 0, x) == (share == 0));
        CHECK_THAT(cells_before(grid, 0, x), WithinAbs(cell + share, 1e-12));
      }
      CHECK(line_position(grid, 0, static_cast<int>(k)) == lines[k]);
    }
    const double last = static_cast<double>(lengths.size());
    CHECK(cells_before(grid, 0, lines.back()) == Approx(last));
    CHECK(cells_between(grid, 0, lines[1], lines.back()) == Approx(last - 1));
    // Outside the end cells go on.
    CHECK(cells_before(grid, 0, lines.front() - lengths.front()) == Approx(-1));
    CHECK(cells_before(grid, 0, lines.back() + 2 * lengths.back()) == Approx(last + 2));
    CHECK(cell_at(grid, 0, lines.back() + 1) == grid.cells[0] - 1);
    CHECK(nearest_line(grid, 0, lines.back() + 1) == grid.cells[0]);
    CHECK(is_on_line(grid, 0, lines.back()));
  }
}

TEST_CASE("a position is put onto a line that it misses by a sliver of its own cell, be the others small or large") {
  const GridSpec grid = by_pieces({{0, 1, 1000}, {1, 2, 2}});  // cells of 0.001 and 0.5
  const auto snapped = [&](double x) {
    std::vector<double> position = {x};
    snap_to_lines(position, grid);
    return position[0];
  };
  CHECK(snapped(1.5 + 0.9e-6 * 0.5) == 1.5);
  CHECK(snapped(1.5 + 1.1e-6 * 0.5) != 1.5);
  CHECK(snapped(0.5 - 0.9e-6 * 0.001) == 0.5);
  CHECK(snapped(0.5 - 1.1e-6 * 0.001) != 0.5);  // 2e-9 of the large cells
  CHECK(snapped(1 + 0.9e-6 * 0.5) == 1);
  const auto moved_into = [&](double x) {
    std::vector<double> position = {x};
    move_into(position, grid.min, grid.max, grid);
    return position[0];
  };
  CHECK(moved_into(2 + 0.9e-6) == 2);
  CHECK(moved_into(2 + 1.1e-6) != 2);
  CHECK(moved_into(-1.8e-9) == 0);
  CHECK(moved_into(-2.2e-9) != 0);
}

TEST_CASE("pieces that miss each other by rounding are joined, and what they miss by more is a fault") {
  const double third = 0.1 + 0.2;  // not 0.3
  Problem problem;
  problem.grid.pieces[0] = {{0, 0.3, 3}, {third, 1, 2}};
  REQUIRE(third != 0.3);
  CHECK(fault_of_pieces(problem).empty());
  take_extent_of_pieces(problem.grid);
  CHECK(problem.grid.pieces[0][1].from == 0.3);
  CHECK(problem.grid.min == std::vector{0.0});
  CHECK(problem.grid.max == std::vector{1.0});
  CHECK(problem.grid.cells == std::vector{5});
  CHECK(fault_of_grid(problem).empty());
  problem.grid.pieces[0][1].from = 0.3 + 1e-9;
  CHECK(fault_of_grid(problem).key == "x[1][0]");
}

TEST_CASE("the grid has a scene's lines, and knows whether they are even") {
  Problem problem;
  problem.grid = three_pieces();
  CHECK(grid_at<1>(problem, 0).axes[0].nodes == grid_lines(problem.grid, 0));
  CHECK_FALSE(grid_at<1>(problem, 0).axes[0].is_even);
  problem.grid = by_pieces({{0, 1, 8}});
  CHECK(grid_at<1>(problem, 0).axes[0].nodes == Axis::uniform(0, 1, 8).nodes);
  CHECK(grid_at<1>(problem, 0).axes[0].is_even);
}

TEST_CASE("a wall that the grid follows leaves unequal lines where they are, but for those nearer than half a cell") {
  Problem problem;
  problem.grid = by_pieces({{0, 4, 4}, {4, 5, 4}});  // cells of 1 and, at the wall on the right, of 0.25
  problem.grid.follow = "gate";
  problem.walls.push_back({.name = "gate", .face = Face::right, .motion = {}});
  const auto check = [&](double moved, const std::vector<double>& expected) {
    CAPTURE(moved);
    CHECK_THAT(grid_at<1>(problem, moved).axes[0].nodes, Catch::Matchers::Approx(expected).margin(1e-14));
  };
  check(0, {0, 1, 2, 3, 4, 4.25, 4.5, 4.75, 5});
  check(0.1, {0, 1, 2, 3, 4, 4.25, 4.5, 4.75, 5.1});
  check(0.3, {0, 1, 2, 3, 4, 4.25, 4.5, 4.75, 5, 5.3});
  check(0.5, {0, 1, 2, 3, 4, 4.25, 4.5, 4.75, 5, 5.25, 5.5});
  check(-0.3, {0, 1, 2, 3, 4, 4.25, 4.5, 4.7});
  check(-1.5, {0, 1, 2, 3, 3.5});
  check(-1.9, {0, 1, 2, 3.1});
  problem.walls[0].face = Face::left;  // there the cells have a length of 1
  check(0.25, {0.25, 1, 2, 3, 4, 4.25, 4.5, 4.75, 5});
  check(-2, {-2, -1, 0, 1, 2, 3, 4, 4.25, 4.5, 4.75, 5});
}
