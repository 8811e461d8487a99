// Points are sorted from phase to phase, and keep their numbers.
#include <stillpoint/stillpoint.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_changes.hpp"
#include "space/points/point_order.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("sorting keeps points by material and cell, and their numbers with them") {
  const Grid<2> grid{{Axis::uniform(0, 4, 8), Axis::uniform(0, 3, 5)}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  MaterialPoints<2> points;
  constexpr std::size_t n = 500;
  for (auto* values : {&points.volume, &points.mass, &points.x[0], &points.x[1]}) values->resize(n);
  for (auto& v : points.v) v.assign(n, 0);
  points.number.resize(n);
  std::iota(points.number.begin(), points.number.end(), 0);
  points.material_begin = {0, 200, static_cast<int>(n)};
  for (std::size_t p = 0; p < n; ++p) points.volume[p] = points.mass[p] = points.v[0][p] = static_cast<double>(p);
  PointOrder<2> order;
  for (int phase = 0; phase < 4; ++phase) {
    for (std::size_t p = 0; p < n; ++p) points.x[0][p] = 4 * uniform(random), points.x[1][p] = 3 * uniform(random);
    const MaterialPoints<2> before = points;
    order.sort(points, grid);
    for (std::size_t p = 0; p < n; ++p) {
      const auto from = static_cast<std::size_t>(order.order().from()[p]);
      CHECK(points.number[p] == before.number[from]);
      CHECK(points.position(p) == before.position(from));
      CHECK(points.volume[p] == points.number[p]);
      CHECK(points.mass[p] == points.number[p]);
      CHECK(points.v[0][p] == points.number[p]);
      CHECK((points.number[p] < 200) == (p < 200));  // each in its material
    }
    for (std::size_t k = 0; k < points.cells(); ++k) {
      CHECK(points.begin(k) < points.end(k));
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        CHECK(grid.cell_number(grid.cell_of(points.position(p))) == points.cell[k]);
        CHECK(points.material_of_cell(k) == (p < 200 ? 0 : 1));
      }
      const bool same_material = k > 0 && points.material_of_cell(k) == points.material_of_cell(k - 1);
      if (same_material) CHECK(points.cell[k] > points.cell[k - 1]);
    }
    CHECK(points.end(points.cells() - 1) == n);
  }
}

TEST_CASE("every output of a point keeps its number from phase to phase, with two materials that turn") {
  // Two bodies, one of them a triangle, turn and fly through the grid: each point along its own line.
  const std::vector<std::string> overrides = {
      "grid={min=[0, 0], max=[4, 4], cells=[16, 16]}",
      "body=[{min=[1, 1], max=[2, 2], material='zinc'}, {polygon=[[2, 1], [3, 1], [2, 2]], material='stuff'}]",
      "material.zinc={law='hencky', E=1e5, nu=0.2, rho=2000}",
      "initial.v=['1 - 0.1*(y - 1.5)', '0.5 + 0.1*(x - 2)']",
      "probe=[{name='far', point=70, fields=['u.x', 'u.y', 'v.x']}]",
      "stop.time=0.8"};
  const Scene scene = free_block(overrides);
  const auto at_start = make_phase(scene);
  const std::vector<double> start = at_start->fields().positions(), volume = at_start->fields().point_data().volumes;
  const std::vector<int> material = at_start->fields().point_data().materials;
  REQUIRE(std::ranges::count(material, 0) > 20);  // 'stuff' comes first by name, though second by body
  REQUIRE(material.front() == 1);
  int changes = 0;
  advanced(scene, 0.8, [&](const Moment& moment, bool after) {
    const LagrangianPhase& phase = moment.phase;
    std::vector<double> u(2 * phase.points()), v(u.size());
    phase.fields().point_displacement(moment.t, moment.u, u);
    phase.fields().point_velocity(moment.t, moment.v, v);
    changes += after ? 1 : 0;
    for (std::size_t p = 0; p < phase.points(); ++p) {
      const double x = start[2 * p], y = start[2 * p + 1];
      // but for the turn within 0.8 s and what the two do to each other where they touch
      CHECK(u[2 * p] == Approx(moment.t * (1 - 0.1 * (y - 1.5))).margin(0.03));
      CHECK(u[2 * p + 1] == Approx(moment.t * (0.5 + 0.1 * (x - 2))).margin(0.03));
      CHECK(phase.fields().point_data().volumes[p] == Approx(volume[p]).epsilon(0.1));
    }
    CHECK(phase.fields().point_data().initial_positions == start);
    CHECK(phase.fields().point_data().materials == material);
  });
  CHECK(changes > 20);
  const Summary s = run(scene, {.threads = 1});
  CHECK(s.probe_positions.at("far") == std::vector<double>{start[2 * 69], start[2 * 69 + 1]});
  CHECK(scenes::probe(s, "far", "u.x") == Approx(0.8 * (1 - 0.1 * (start[2 * 69 + 1] - 1.5))).margin(0.03));
  CHECK(scenes::probe(s, "far", "u.y") == Approx(0.8 * (0.5 + 0.1 * (start[2 * 69] - 2))).margin(0.03));
}
