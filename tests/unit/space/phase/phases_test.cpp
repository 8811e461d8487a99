// A body that moves on from phase to phase: what stays, what is carried over, what ends a phase.
#include <stillpoint/stillpoint.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "largest.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/points/point_order.hpp"

using namespace stillpoint;
using stillpoint::test::free_block;
using stillpoint::test::free_soil;
using stillpoint::test::TemporaryFolder;

namespace {

/// The state when a phase ends, or when the next has begun.
struct Moment {
  double t;
  const LagrangianPhase& phase;
  ConstVec u, v;
};
/// Steps a scene until t_end. at_change(moment, after): before and after each change of phase.
Simulation advanced(const Scene& scene, double t_end,
                    const std::function<void(const Moment&, bool after)>& at_change = {}) {
  const Simulation* self = nullptr;
  const auto tell = [&](bool after) {
    if (at_change) at_change({self->t(), self->parts().phase, self->u(), self->v()}, after);
  };
  Simulation simulation(scene, {.records = false, .stops = false, .at_phase_change = tell});
  self = &simulation;
  REQUIRE(simulation.run_until(t_end) == RunStatus::running);
  return simulation;
}

/// Σ m_p v_p by the points' velocities, their masses from the volumes of the start.
Point<2> momentum(const Moment& moment, const std::vector<double>& volume_at_start, double rho) {
  std::vector<double> v(2 * moment.phase.points());
  moment.phase.fields().point_velocity(moment.t, moment.v, v);
  Point<2> sum{};
  for (std::size_t p = 0; p < volume_at_start.size(); ++p) {
    for (std::size_t i = 0; i < 2; ++i) sum[i] += rho * volume_at_start[p] * v[2 * p + i];
  }
  return sum;
}

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

Scene wall_on(const std::string& face, const std::string& motion = "t") {
  return free_block({"wall=[{name='gate', face='" + face + "', motion='" + motion + "'}]", "grid.follow=gate"});
}

}  // namespace

TEST_CASE("linear momentum goes over from each phase to the next, whatever the basis, the law and the transfer") {
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string transfer :
         {"transfer='flip'", "transfer='flip', flip_share=0.9", "transfer='pic'", "transfer='apic'",
          "transfer='xpic', xpic_order=1", "transfer='xpic', xpic_order=5"}) {
      for (const bool soil : {false, true}) {
        CAPTURE(basis, transfer, soil);
        const std::vector<std::string> overrides = {"initial.v=['0.8 + 0.5*(y - 0.5)', '0.2*(x - 1)']",
                                                    "grid.basis=" + basis, "integrator.step_fraction=0.2",
                                                    "phase={max_motion=0.1, " + transfer + "}"};
        const Scene scene = soil ? free_soil(overrides) : free_block(overrides);
        const auto at_start = make_phase(scene);
        const std::vector<double> volume = at_start->fields().point_data().volumes;
        const double scale = at_start->info().total_mass;  // times 1 m/s
        Point<2> before{};
        int changes = 0;
        Simulation simulation = advanced(scene, 0.25, [&](const Moment& moment, bool after) {
          const Point<2> now = momentum(moment, volume, 1000);
          if (after) {
            ++changes;
            for (std::size_t i = 0; i < 2; ++i) CHECK(std::abs(now[i] - before[i]) < 1e-13 * scale);
          }
          before = now;
        });
        CHECK(changes >= 6);
        const TransferErrors errors = simulation.parts().phase.control().transfer_errors();
        CHECK(errors.mass < 1e-14);
        CHECK(errors.momentum < 1e-12);
        CHECK(errors.added_mass < 0.15);
        // The sum over the grid's momentum of the start: Σ m_p v_p of the field, whose mean is at the block's middle.
        CHECK(std::abs(before[0] - 0.8 * scale) < 1e-12 * scale);
        CHECK(std::abs(before[1] - 0.025 * scale) < 1e-12 * scale);
      }
    }
  }
}

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

TEST_CASE("a block falls freely as it should, in one phase as in many, and stays as it is") {
  const auto fall = [](const std::string& max_motion, const std::string& basis) {
    return run(free_block({"grid={min=[0, 0], max=[2, 4], cells=[8, 16], basis='" + basis + "'}",
                           "body={min=[0.55, 2.8], max=[1.5, 3.75]}", "body_force.value=[0, -9.81]", "stop.time=0.6",
                           "phase.max_motion=" + max_motion,
                           "probe=[{name='middle', at=[1, 3.25], fields=['u.y', 'stress.yy']}]"}),
               {.threads = 1});
  };
  constexpr double way = -9.81 * 0.6 * 0.6 / 2;
  CHECK(scenes::probe(fall("none", "linear"), "middle", "u.y") == Approx(way).epsilon(1e-12));
  for (const char* max_motion : {"0.1", "0"}) {
    for (const char* basis : {"linear", "quadratic", "cubic"}) {
      CAPTURE(max_motion, basis);
      const Summary s = fall(max_motion, basis);
      CHECK(s.phases >= 10);
      CHECK(*s.added_mass > 0.001);  // light nodes there are, but they fall like the rest
      CHECK(*s.momentum_error < 1e-12);
      CHECK(scenes::probe(s, "middle", "u.y") == Approx(way).epsilon(1e-9));
      CHECK(std::abs(scenes::probe(s, "middle", "stress.yy")) < 1e-9 * 1e4);
    }
  }
}

TEST_CASE("a free body keeps its momentum through 200 phases, and with apic its angular momentum") {
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string transfer : {"flip", "pic", "apic", "xpic"}) {
      CAPTURE(basis, transfer);
      const Summary s =
          run(free_block({"grid={min=[-1, -1], max=[2, 1], cells=[24, 16], basis='" + basis + "'}",
                          "body={min=[-0.52, -0.31], max=[0.23, 0.44]}", "phase.transfer=" + transfer,
                          "material.stuff={law='neo-hookean', E=1e5, nu=0.3, rho=1000}",
                          "initial.v=['1 - 3*y + 0.5*exp(-2*x)', '3*x']", "stop.time=0.6", "phase.max_motion=0.025"}),
              {.threads = 1});
      REQUIRE(s.status == RunStatus::end_time);
      CHECK(s.phases >= 200);
      CHECK(*s.added_mass > 0.01);
      CHECK(*s.momentum_error < 1e-12);
      REQUIRE(s.angular_momentum_error);
      if (transfer == "apic") CHECK(*s.angular_momentum_error < (basis == "linear" ? 0.01 : 1e-10));
    }
  }
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
