// Points that go from rank to rank.
#include "space/points/migration.hpp"

#include <stillpoint/scene.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "space/grid/scene_grid.hpp"
#include "space/points/make_body.hpp"
#include "thread_ranks.hpp"

using namespace stillpoint;
using test::as_ranks;

namespace {

constexpr auto plane = Kinematics::plane;

Scene two_materials() {
  return load_scene("walk.toml", R"(
dim = 2
[grid]
min = [0.0, 0.0]
max = [12.0, 8.0]
cells = [12, 8]
[[body]]
material = "elastic"
max = [12.0, 3.0]
points_per_cell = 4
state = "plane-strain"
[[body]]
material = "soil"
min = [0.0, 3.0]
max = [12.0, 6.0]
points_per_cell = 4
state = "plane-strain"
[material.elastic]
law = "neo-hookean"
E = 1.0
nu = 0.3
rho = 1.0
[material.soil]
law = "drucker-prager"
E = 1.0
nu = 0.3
rho = 2.0
phi = 30.0
psi = 0.0
c = 1.0
[phase]
max_motion = 0.1
[damping]
strategy = "none"
[stop]
residual = 0
time = 1.0
)",
                    {});
}

/// A body every number of which tells its point, and which moves at random.
struct Walk {
  Walk() : grid(grid_at<2>(scene, 0)), body(make_body<plane>(scene, grid, true)) {
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
      const auto begin = static_cast<std::size_t>(body.points.material_begin[m]);
      const auto count = static_cast<std::size_t>(body.points.material_begin[m + 1]) - begin;
      const Vec memory = body.materials[m]->memory();
      for (std::size_t row = 0; row < body.materials[m]->memory_rows(); ++row)
        for (std::size_t k = 0; k < count; ++k) memory[row * count + k] = told(row, body.points.number[begin + k]);
    }
    for (std::size_t p = 0; p < body.points.size(); ++p) body.points.mass[p] = body.points.number[p];
  }
  static double told(std::size_t row, int number) { return 1e4 * static_cast<double>(row + 1) + number; }

  // Moves the points, the same ones of any division alike.
  void move(unsigned phase) {
    auto& points = body.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
      std::mt19937_64 random(1000 * static_cast<unsigned>(points.number[p]) + phase);
      for (std::size_t d = 0; d < 2; ++d) {
        double& x = points.x[d][p];
        x = std::clamp(x + std::uniform_real_distribution<double>(-0.6, 0.6)(random), 0.0, d == 0 ? 11.9 : 7.9);
      }
    }
    order.cells().resize(points.size());
    for (std::size_t p = 0; p < points.size(); ++p)
      order.cells()[p] = grid.cell_number(grid.cell_of(points.position(p)));
  }
  void sort() {
    order.sort_by_cells(body.points, grid);
    std::vector<double> work;
    for (auto& material : body.materials) material->reorder(order.order(), work);
  }
  // The cells, each with its material and its points in their order.
  std::vector<std::vector<int>> cells() const {
    std::vector<std::vector<int>> all;
    for (std::size_t k = 0; k < body.points.cells(); ++k) {
      all.push_back({body.points.material_of_cell(k), body.points.cell[k]});
      for (std::size_t p = body.points.begin(k); p < body.points.end(k); ++p)
        all.back().push_back(body.points.number[p]);
    }
    return all;
  }
  // Whether every number still is of its point.
  bool is_sound() const {
    bool sound = true;
    for (std::size_t p = 0; p < body.points.size(); ++p) sound = sound && body.points.mass[p] == body.points.number[p];
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
      const auto begin = static_cast<std::size_t>(body.points.material_begin[m]);
      const auto count = static_cast<std::size_t>(body.points.material_begin[m + 1]) - begin;
      const Vec memory = body.materials[m]->memory();
      sound = sound && memory.size() == count * body.materials[m]->memory_rows();
      for (std::size_t row = 0; sound && row < body.materials[m]->memory_rows(); ++row)
        for (std::size_t k = 0; k < count; ++k)
          sound = sound && memory[row * count + k] == told(row, body.points.number[begin + k]);
    }
    return sound;
  }

  Scene scene = two_materials();
  Grid<2> grid;
  Body<plane> body;
  PointOrder<2> order;
};

// Another division of the cells in each phase.
RankCells<2> division(const Grid<2>& grid, int count, unsigned phase) {
  RankCells<2> cells(grid, count);
  std::mt19937_64 random(phase);
  std::vector<PointsOfCell> weights;
  for (int cell = 0; cell < grid.cells(); ++cell)
    weights.push_back({cells.place(grid.cell_at(cell)), static_cast<std::int64_t>(random() % 20)});
  cells.share_out(std::move(weights));
  return cells;
}

}  // namespace

TEST_CASE(
    "in 200 phases, each with another division of the cells, no point is lost, and all are in the order of one "
    "process") {
  constexpr unsigned phases = 200;
  std::vector<std::vector<std::vector<int>>> expected;
  Walk alone;
  for (unsigned phase = 0; phase < phases; ++phase) {
    alone.move(phase);
    alone.sort();
    expected.push_back(alone.cells());
  }
  REQUIRE(alone.is_sound());
  for (auto& cells : expected) std::ranges::sort(cells);
  for (const int count : {2, 3, 5}) {
    std::vector<std::vector<std::vector<int>>> found(phases);
    std::mutex finding;
    std::vector<char> sound(static_cast<std::size_t>(count), 1);
    as_ranks(count, [&](const Ranks& ranks) {
      Walk walk;
      // At first one rank has all points, and the others have none.
      if (ranks.rank() != count - 1) {
        walk.body.points.material_begin.assign(3, 0);
        take_points(walk.body.points, {});
        take_materials(walk.body, {});
        walk.order.sort(walk.body.points, walk.grid);
      }
      for (unsigned phase = 0; phase < phases; ++phase) {
        walk.move(phase);
        Migration<plane>(ranks, walk.body).run(division(walk.grid, count, phase), walk.grid, walk.order.cells());
        walk.sort();
        if (!walk.is_sound()) sound[static_cast<std::size_t>(ranks.rank())] = 0;
        const std::vector<std::vector<int>> cells = walk.cells();
        const std::lock_guard lock(finding);
        found[phase].insert(found[phase].end(), cells.begin(), cells.end());
      }
    });
    for (const char one : sound) CHECK(one);
    for (unsigned phase = 0; phase < phases; ++phase) {
      std::ranges::sort(found[phase]);
      if (found[phase] != expected[phase]) FAIL("phase " << phase << " on " << count << " ranks");
    }
  }
}

TEST_CASE("cells are shared out by their points, in one row, and every rank has some while there are as many cells") {
  Grid<2> grid;
  grid.axes = {Axis::uniform(0, 10, 10), Axis::uniform(0, 3, 3)};
  RankCells<2> cells(grid, 4);
  std::vector<PointsOfCell> all;
  for (int cell = 0; cell < grid.cells(); ++cell) all.push_back({cells.place(grid.cell_at(cell)), 5});
  std::mt19937_64 random(2);
  std::ranges::shuffle(all, random);
  cells.share_out(all);
  std::vector<int> points(4), last(4, -1);
  int before = 0;
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 3; ++y) {
      const int owner = cells.owner({x, y});
      CHECK(owner >= before);  // column after column
      before = owner;
      points[static_cast<std::size_t>(owner)] += 5;
    }
  }
  for (const int of_rank : points) CHECK(std::abs(of_rank - 37.5) <= 2.5);
}
