// What ends a phase, what a step in it may be, and the grid of the next.
#include <stillpoint/stillpoint.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "largest.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_changes.hpp"
#include "space/points/point_order.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

/// A block of rubber on a smooth floor, under its weight all at once. n cells a metre, the block 1 m × 1 m.
Summary squash(int n, const std::vector<std::string>& overrides) {
  const std::string cells = std::to_string(2 * n) + ", " + std::to_string(5 * n / 4);
  std::vector<std::string> all = {"grid={min=[-0.5, 0], max=[1.5, 1.25], cells=[" + cells + "]}",
                                  "body={min=[0, 0], max=[1, 1], material='stuff', points_per_cell=4}",
                                  "material.stuff={law='neo-hookean', E=1e5, nu=0.3, rho=1000}",
                                  "support=[{face='bottom', kind='roller'}]",
                                  "body_force.value=[0, -9.81]",
                                  "probe=[{name='top', at=[0.5, 1], fields=['u.y']}]",
                                  "stop.time=0.2"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  const Summary s = run(free_block(all), {.threads = 1});
  REQUIRE(s.status == RunStatus::end_time);
  return s;
}
double settlement(const Summary& s) { return -scenes::probe(s, "top", "u.y"); }

}  // namespace

TEST_CASE("a phase ends where phase.max_motion or phase.max_strain says, and never where it says none") {
  const auto phases = [](const std::string& phase) {
    return run(free_block({"initial.v=['1 + 0.5*(x - 1.125)', 0]", "stop.time=0.2", "phase=" + phase}), {.threads = 1})
        .phases;
  };
  CHECK(phases("{max_motion='none'}") == 1);
  // Up to 1.3 m/s for 0.2 s are 1.05 cells; a step is some 0.1 of one.
  const int fifth = phases("{max_motion=0.2}"), half = phases("{max_motion=0.5}");
  CHECK(fifth >= 4);
  CHECK(fifth <= 6);
  CHECK(half >= 2);
  CHECK(half <= 3);
  const Summary classical = run(free_block({"initial.v=[1, 0]", "phase={max_motion=0}"}), {.threads = 1});
  CHECK(classical.phases == classical.steps);  // all but after the last
  // Strains reach 0.5/s · 0.2 s at most.
  CHECK(phases("{max_motion='none', max_strain=0.02}") > 1);
  CHECK(phases("{max_motion='none', max_strain=0.5}") == 1);
}

TEST_CASE("phases move an elastic block as classical MPM does, ever closer with the grid and with max_motion") {
  // A smooth basis: if points cross cells a linear one makes forces jump, whatever the phases.
  // Of an oscillation at one moment, so that a coarse grid may agree by chance: measured 2e-3, 6e-3, 6e-4.
  for (const auto& [n, most] : {std::pair{4, 0.01}, {8, 0.01}, {16, 0.002}}) {
    const double classical = settlement(squash(n, {"grid.basis=quadratic", "phase.max_motion=0"}));
    const double phases = settlement(squash(n, {"grid.basis=quadratic"}));
    const double difference = std::abs(phases / classical - 1);
    UNSCOPED_INFO(n << " cells: " << classical << " m, with phases " << difference << " of it off");
    CHECK(difference < most);
  }
  const double one_phase = settlement(squash(16, {"grid.basis=quadratic", "phase.max_motion=none"}));
  CHECK(settlement(squash(16, {"grid.basis=quadratic"})) == Approx(one_phase).epsilon(0.02));
  // On the linear basis, too, a shorter phase comes closer to the classical step.
  const double linear = settlement(squash(16, {"phase.max_motion=0"}));
  CHECK(settlement(squash(16, {"phase.max_motion=0.1"})) == Approx(linear).epsilon(0.03));
  CHECK(settlement(squash(16, {"phase.max_motion=0.05"})) == Approx(linear).epsilon(0.01));
}

TEST_CASE("a step that would move the body half as far again as a phase allows is refused and halved") {
  // 1 m/s with cells of 0.25 m and the step of a soft body: 0.37 of a cell and more in one step.
  const std::vector<std::string> fast = {"initial.v=['20', '0']", "grid={min=[0, 0], max=[9, 1], cells=[36, 4]}",
                                         "stop.time=0.3"};
  for (const char* phase : {"{max_motion=0.1}", "{max_motion='none', max_strain=0.01}"}) {
    CAPTURE(phase);
    std::vector<std::string> overrides = fast;
    overrides.push_back(std::string("phase=") + phase);
    overrides.emplace_back(phase[1] == 'm' && phase[12] == '0' ? "initial.v=['20', '0']"
                                                               : "initial.v=['1 + 4*(x - 1)', '0']");
    const Scene scene = free_block(overrides);
    const double most = scene.phase.ends_by_motion() ? 1.5 * scene.phase.max_motion : 1.5 * *scene.phase.max_strain;
    double furthest = 0;
    Simulation simulation = advanced(scene, 0.29, [&](const Moment& moment, bool after) {
      if (after) return;
      if (scene.phase.ends_by_motion()) {
        furthest = std::max(furthest, largest_magnitude(moment.u) / 0.25);
      } else {
        std::vector<double> strain(4 * moment.phase.points());
        moment.phase.fields().point_strain(moment.t, moment.u, strain);
        furthest = std::max(furthest, largest_magnitude(strain));
      }
    });
    CHECK(simulation.summary().rejected_steps > 0);
    CHECK(furthest > 0);
    CHECK(furthest <= most * (1 + 1e-12));
  }
}

TEST_CASE(
    "a grid that follows a wall adds and removes columns there, the last 0.5 to 1.5 cells wide, and nothing else") {
  for (const std::string face : {"right", "left", "top", "bottom"}) {
    const Scene scene = wall_on(face);
    const std::size_t d = face == "right" || face == "left" ? 0 : 1;
    const bool upper = face == "right" || face == "top";
    const Grid<2> start = grid_at<2>(scene, 0);
    const std::vector<double>& before = start.axes[d].nodes;
    constexpr double h = 0.25;
    std::set<int> counts;
    for (int k = -16; k <= 40; ++k) {
      const double moved = 0.045 * k * (upper ? 1 : -1);  // outwards, and a little inwards
      CAPTURE(face, moved);
      const Grid<2> grid = grid_at<2>(scene, moved);
      CHECK(grid.axes[1 - d].nodes == start.axes[1 - d].nodes);
      std::vector<double> now = grid.axes[d].nodes, then = before;
      CHECK(std::is_sorted(now.begin(), now.end()));
      if (!upper) {
        std::ranges::reverse(now);
        std::ranges::reverse(then);
      }
      CHECK(now.front() == Approx(then.front()).margin(1e-15));
      CHECK(now.back() == Approx(then.back() + moved).margin(1e-14));
      for (std::size_t i = 0; i + 1 < std::min(now.size(), then.size()); ++i)
        CHECK(now[i] == Approx(then[i]).margin(1e-14));
      const double last = std::abs(now.back() - now[now.size() - 2]);
      CHECK(last > 0.5 * h - 1e-12);
      CHECK(last < 1.5 * h + 1e-12);
      for (std::size_t i = 0; i + 2 < now.size(); ++i) CHECK(std::abs(now[i + 1] - now[i]) == Approx(h).epsilon(1e-12));
      counts.insert(grid.axes[d].cells());
    }
    CHECK(counts.size() > 8);  // from 3 fewer to 7 more
  }
  // A grid without a wall to follow stays.
  CHECK(grid_at<2>(free_block(), 0.3).axes[0].nodes == grid_at<2>(free_block(), 0).axes[0].nodes);
}

TEST_CASE("the followed wall stays on the last grid line from phase to phase") {
  const Scene scene =
      free_block({"wall=[{name='gate', face='right', motion='0.5*t'}]", "grid.follow=gate", "initial.v=[0.5, 0]"});
  const int cells = make_phase(scene)->shape().discretisation().grid_cells.at(0);
  Simulation simulation = advanced(scene, 0.9);
  CHECK(simulation.parts().phase.shape().discretisation().grid_cells.at(0) == cells + 2);  // 0.45 m are 1.8 cells
  CHECK(simulation.parts().phase.shape().discretisation().grid_cells.at(1) == 4);
}
