// Points that move on to other cells, and what goes with them.
#include "space/points/point_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "space/points/next_cells.hpp"

using namespace stillpoint;

namespace {

/// Points of two materials in a grid of 12 × 10 cells, four in each, every array of which says which point it is.
struct Heap {
  Heap() {
    grid.axes = {Axis::uniform(0, 12, 12), Axis::uniform(0, 10, 10)};
    points.material_begin = {0, 200, 480};
    const std::size_t n = 480;
    for (std::size_t p = 0; p < n; ++p) {
      const std::size_t cell = p / 4, row = cell / 12;
      points.x[0].push_back(static_cast<double>(cell % 12) + 0.25 + 0.5 * static_cast<double>(p % 2));
      points.x[1].push_back(static_cast<double>(row) + 0.25 + (p % 4 < 2 ? 0 : 0.5));
    }
    points.number.resize(n);
    std::iota(points.number.begin(), points.number.end(), 0);
    points.mass.assign(points.number.begin(), points.number.end());
    points.volume = points.mass;
    for (std::size_t d = 0; d < 2; ++d) points.v[d] = points.x[d];
    for (std::size_t m = 0; m < 2; ++m) {
      const std::size_t begin = points.material_begin[m], count = points.material_begin[m + 1] - begin;
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t k = 0; k < count; ++k)
          history[m].push_back(1000.0 * static_cast<double>(row) + points.mass[begin + k]);
      }
    }
    order.sort(points, grid);
  }
  // Some points, one in `every`, go somewhere else.
  void scatter(unsigned every) {
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (random() % every == 0) {
        points.x[0][p] = std::uniform_real_distribution<double>(0, 12)(random);
        points.x[1][p] = std::uniform_real_distribution<double>(0, 10)(random);
      }
      points.v[0][p] = points.x[0][p];
      points.v[1][p] = points.x[1][p];
    }
  }
  // The sort that the fast one has to agree with.
  std::vector<int> expected_numbers() const {
    std::vector<int> from(points.size());
    std::iota(from.begin(), from.end(), 0);
    const auto cell = [&](int p) {
      return grid.cell_number(grid.cell_of(points.position(static_cast<std::size_t>(p))));
    };
    for (std::size_t m = 0; m < 2; ++m) {
      std::stable_sort(from.begin() + points.material_begin[m], from.begin() + points.material_begin[m + 1],
                       [&](int p, int q) { return cell(p) < cell(q); });
    }
    std::vector<int> numbers;
    for (const int p : from) numbers.push_back(points.number[static_cast<std::size_t>(p)]);
    return numbers;
  }

  Grid<2> grid;
  MaterialPoints<2> points;
  std::array<std::vector<double>, 2> history;  // of each material, three rows
  PointOrder<2> order;
  std::mt19937 random{3};
};

}  // namespace

TEST_CASE("a sort takes along all that is kept of a point, however many change cell") {
  const unsigned every = GENERATE(1u, 3u, 50u, 10000u);
  CAPTURE(every);
  Heap heap;
  std::vector<double> work;
  for (int phase = 0; phase < 4; ++phase) {
    heap.scatter(every);
    const std::vector<int> expected = heap.expected_numbers();
    heap.order.sort(heap.points, heap.grid);
    REQUIRE(heap.points.number == expected);
    for (std::size_t m = 0; m < 2; ++m) {
      const auto begin = static_cast<std::size_t>(heap.points.material_begin[m]);
      const std::size_t count = heap.history[m].size() / 3;
      heap.order.order().apply(heap.history[m], work, begin, count);
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t k = 0; k < count; ++k)
          REQUIRE(heap.history[m][count * row + k] ==
                  1000.0 * static_cast<double>(row) + heap.points.number[begin + k]);
      }
    }
    for (std::size_t p = 0; p < heap.points.size(); ++p) {
      REQUIRE(heap.points.mass[p] == heap.points.number[p]);
      REQUIRE(heap.points.volume[p] == heap.points.number[p]);
      REQUIRE(heap.points.v[0][p] == heap.points.x[0][p]);
      REQUIRE(heap.points.v[1][p] == heap.points.x[1][p]);
    }
    // The list of cells: ascending within a material, each with its points.
    std::size_t listed = 0;
    for (std::size_t k = 0; k < heap.points.cells(); ++k) {
      REQUIRE(heap.points.begin(k) == listed);
      for (; listed < heap.points.end(k); ++listed)
        REQUIRE(heap.grid.cell_number(heap.grid.cell_of(heap.points.position(listed))) == heap.points.cell[k]);
    }
    REQUIRE(listed == heap.points.size());
  }
}

TEST_CASE("the cells that points move on to are those that the next grid has there") {
  const int columns = GENERATE(10, 12, 13);  // of the next grid, whose last one ends at a wall
  CAPTURE(columns);
  Heap heap;
  Grid<2> next = heap.grid;
  next.axes[0] = Axis::uniform(0, columns, columns);
  next.axes[0].nodes.back() = columns + 0.3;
  const NextCells<2> next_cells(next);
  std::array<std::vector<double>, 2> x = heap.points.x;
  std::vector<int> cell(heap.points.size(), -1);
  for (std::size_t p = 0; p < cell.size(); ++p) {
    for (auto& along : x) along[p] += std::uniform_real_distribution<double>(-0.8, 0.8)(heap.random);
  }
  x[0][5] = std::ceil(heap.points.x[0][5]);  // on the line at its cell's end, which is the next cell's
  x[1][5] = heap.points.x[1][5];
  x[1][7] = 10;
  for (std::size_t k = 0; k < heap.points.cells(); ++k) {
    bool all_inside = true;
    const auto here = heap.grid.cell_at(heap.points.cell[k]);
    const bool said = next_cells.find(heap.points, k, here, x, cell).all_inside;
    for (std::size_t p = heap.points.begin(k); p < heap.points.end(k); ++p) {
      CHECK(cell[p] == next.cell_number(next.cell_of({x[0][p], x[1][p]})));
      all_inside = all_inside && x[0][p] >= 0 && x[0][p] <= columns + 0.3 && x[1][p] >= 0 && x[1][p] <= 10;
    }
    CHECK(said == all_inside);
  }
}

TEST_CASE("a point that is nowhere is outside every cell") {
  Heap heap;
  std::array<std::vector<double>, 2> x = heap.points.x;
  x[1][0] = std::numeric_limits<double>::quiet_NaN();
  std::vector<int> cell(heap.points.size());
  CHECK_FALSE(NextCells<2>(heap.grid).find(heap.points, 0, heap.grid.cell_at(heap.points.cell[0]), x, cell).all_inside);
  CHECK(NextCells<2>(heap.grid).find(heap.points, 1, heap.grid.cell_at(heap.points.cell[1]), x, cell).all_inside);
}
