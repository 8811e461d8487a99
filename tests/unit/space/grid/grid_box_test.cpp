// A grid of which the cells of a box alone have numbers.
#include <vector>

#include <catch2/catch.hpp>

#include "space/grid/basis.hpp"
#include "space/grid/cells_around.hpp"
#include "space/points/numbered_cells.hpp"

namespace stillpoint {
namespace {

using Plane = TensorBasis<BSpline<2>, 2>;

Grid<2> twelve_by_ten() { return {{Axis::uniform(0, 12, 12), Axis::uniform(0, 5, 10)}}; }
Grid<2> boxed() {
  Grid<2> grid = twelve_by_ten();
  grid.box = {CellRange{3, 7}, CellRange{0, 4}};
  return grid;
}

TEST_CASE("the cells of a box have the numbers of a grid that is the box, in the order of those of the whole") {
  const Grid<2> whole = twelve_by_ten(), grid = boxed();
  REQUIRE(grid.cells() == 4 * 4);
  int before = -1;
  for (int number = 0; number < grid.cells(); ++number) {
    const auto cell = grid.cell_at(number);
    CHECK(grid.holds(cell));
    CHECK(grid.cell_number(cell) == number);
    CHECK(whole.cell_number(cell) > before);
    before = whole.cell_number(cell);
  }
  CHECK(grid.cell_at(0) == std::array{3, 0});
  CHECK_FALSE(grid.holds({2, 0}));
  CHECK_FALSE(grid.holds({7, 0}));
  CHECK_FALSE(grid.holds({3, 4}));
  CHECK(grid.cell_of({4.5, 0.6}) == std::array{4, 1});
  CHECK(grid.cell_of({0.5, 4.9}) == std::array{3, 3});  // outside: the nearest
  CHECK(grid.cell_of({100, -1}) == std::array{6, 0});
}

TEST_CASE("the functions of a box are those of its cells in the whole grid, at the same places") {
  const Grid<2> whole = twelve_by_ten(), grid = boxed();
  REQUIRE(Plane::count(grid) == 6 * 6);
  const auto offset = Plane::offsets(grid), offset_in_whole = Plane::offsets(whole);
  for (int number = 0; number < grid.cells(); ++number) {
    const auto cell = grid.cell_at(number);
    for (std::size_t a = 0; a < offset.size(); ++a) {
      const int function = Plane::first(grid, cell) + offset[a];
      const auto places = Plane::places_of(grid, function);
      CHECK(places == Plane::places_of(whole, Plane::first(whole, cell) + offset_in_whole[a]));
      CHECK(Plane::number_at(grid, places) == function);
    }
  }
  CHECK(Plane::number_at(grid, {2, 0}) == -1);
  CHECK(Plane::number_at(grid, {9, 0}) == -1);
  CHECK(Plane::number_at(grid, {3, 6}) == -1);
}

TEST_CASE("a box has functions on the faces of the grid that it reaches, and on no others") {
  const Grid<2> grid = boxed();
  CHECK(Plane::face_functions(grid, /*axis=*/1, /*upper=*/false).size() == 6);
  CHECK(Plane::face_functions(grid, 1, true).empty());
  CHECK(Plane::face_functions(grid, 0, false).empty());
  CHECK(Plane::face_functions(grid, 0, true).empty());
  int cells = 0;
  for_cells_around(grid, {3, 0}, 2, [&](int) { ++cells; });
  CHECK(cells == 3 * 3);
}

TEST_CASE("functions get the numbers of another box in their order, and none where they are not in it") {
  Grid<2> before = boxed(), now = boxed();
  now.box = {CellRange{5, 9}, CellRange{0, 4}};
  const std::vector<int> number = NumberedCells<2>::now_of<Plane>(before, now, /*fields=*/2);
  REQUIRE(number.size() == 2 * 36);
  int known = 0, last = -1;
  for (std::size_t f = 0; f < number.size(); ++f) {
    const auto places = Plane::places_of(before, static_cast<int>(f % 36));
    CHECK((number[f] >= 0) == (places[0] >= 5));
    if (number[f] < 0) continue;
    CHECK(Plane::places_of(now, number[f] % 36) == places);
    CHECK(number[f] / 36 == static_cast<int>(f / 36));
    CHECK(number[f] > last);
    last = number[f];
    ++known;
  }
  CHECK(known == 2 * 4 * 6);
}

TEST_CASE("a box follows what moves, keeps its numbers while that is amid it, and ends at the grid") {
  Grid<2> grid{{Axis::uniform(0, 400, 400), Axis::uniform(0, 100, 100)}};
  grid.box = {CellRange{92, 112}, CellRange{0, 12}};
  const auto around = [&](int x, int y) {
    return NumberedCells<2>::around_points(grid, {{x, y}, {x + 3, y + 1}}, /*motion=*/0.1);
  };
  CHECK(around(100, 0) == grid.box);
  CHECK(around(102, 3) == grid.box);
  const auto moved = around(104, 3);
  CHECK(moved != grid.box);
  CHECK(moved[0].first <= 104 - 8);
  CHECK(moved[0].end >= 108 + 8);
  CHECK(moved[1].first == 0);
  const auto at_the_end = around(396, 98);
  CHECK(at_the_end[0].end == 400);
  CHECK(at_the_end[1].end == 100);
  grid.box = {};
  CHECK(around(100, 0) == Grid<2>::Box{});
}

}  // namespace
}  // namespace stillpoint
