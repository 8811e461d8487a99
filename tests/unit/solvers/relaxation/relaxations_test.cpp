// What all strategies have in common: where they lead, that they are repeatable, and what they refuse.
#include <stillpoint/spectrum.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <omp.h>

#include "allocation_count.hpp"
#include "plan/catalogue.hpp"
#include "scenes.hpp"
#include "solvers/relaxation/relaxing.hpp"
#include "temporary_folder.hpp"
#include "way_to_rest.hpp"
#include "yielding_block.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("every strategy leads to the static solution of a linear, a stiffening and a consistent-mass chain",
          "[strategies]") {
  struct Case {
    const char* name;
    ChainOptions options;
  };
  const std::vector<double> masses = {1, 2, 0.5, 1.5, 1, 3, 1, 0.7, 1, 1, 2, 1};
  for (const Case& c : {Case{"linear", {.masses = masses, .load = 0.1}},
                        {"cubic", {.cubic = 0.4, .masses = masses, .right_held = true, .load = 0.1}},
                        {"consistent", {.masses = masses, .consistent = true, .load = 0.1}}}) {
    Chain chain(c.options);
    const Values solution = static_solution(chain);
    const double omega_max = omega_max_by_arpack(chain, 0, solution).omega;
    for (const std::string& strategy : iterations) {
      const double omega_1 = 0.9 * omega_1_by_arpack(chain, 0, Values(chain.size())).omega;
      CAPTURE(c.name, strategy);
      CHECK(evaluations_to(1e-10, chain, solution, omega_max,
                           {.strategy = strategy,
                            .step_fraction = strategy == "chebyshev" ? 1 : 0.9,
                            .options = {.omega_1 = omega_1}},
                           20'000) < 20'000);
    }
    const Way combined = {.strategy = "combined", .step_fraction = 0.9 / std::sqrt(1.7), .alpha = 0.7};
    CHECK(evaluations_to(1e-10, chain, solution, omega_max, combined, 50'000) < 50'000);
  }
}

TEST_CASE(
    "every strategy relaxes a neo-Hookean bar to its equilibrium, with physical mass and scaled by Gershgorin's "
    "bound",
    "[strategies]") {
  std::vector<std::string> all = iterations;
  all.push_back("combined");
  for (const std::string& strategy : all) {
    for (const bool scaled : {false, true}) {
      std::vector<std::string> set = {override_of(strategy), "stop.residual=1e-9", "stop.steps=50000"};
      if (scaled) set.insert(set.end(), {"mass.kind=lumped", "mass.scaling=gershgorin"});
      const Summary summary = run(scenes::load("neo_hookean_bar", set));
      CAPTURE(strategy, scaled, summary.reason, summary.rhs_evaluations);
      CHECK(summary.status == RunStatus::equilibrium);
      CHECK((catalogue().static_method(strategy) ? summary.method : summary.damping) == strategy);
      REQUIRE(summary.error);
      CHECK(summary.error->u_rel_l2 < 1e-7);
    }
  }
}

TEST_CASE("adapted damping is reported as the c in force, and that of strategies without one as none", "[strategies]") {
  const auto c_of = [](const std::string& strategy) {
    return run(scenes::load("neo_hookean_bar", {override_of(strategy)})).c;
  };
  const Summary summary = run(scenes::load("neo_hookean_bar"));
  for (const std::string strategy : {"adaptive", "papadrakakis"}) {
    const auto c = c_of(strategy);
    REQUIRE(c);
    CHECK(*c == Approx(2 * *summary.omega_1).epsilon(0.6));
  }
  CHECK_FALSE(c_of("kinetic"));
  CHECK_FALSE(c_of("cg"));
}

TEST_CASE("strategies give the same bits for any number of threads", "[strategies]") {
  const auto steps_with = [](const std::string& strategy, int threads) {
    omp_set_num_threads(threads);
    Chain chain({.n = 20'000, .cubic = 0.5, .right_held = true, .load = 0.01});
    Values waves(2 * chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) waves[i] = 0.01 * std::sin(0.3 * static_cast<double>(i));
    Relaxing relaxing(chain, {.strategy = strategy, .options = {.omega_1 = 0.1}}, 0.9, waves);
    for (int k = 0; k < 40; ++k) relaxing.step();
    return relaxing.y;
  };
  const int before = omp_get_max_threads();
  for (const std::string& strategy : iterations) {
    CAPTURE(strategy);
    CHECK(steps_with(strategy, 1) == steps_with(strategy, 3));
  }
  omp_set_num_threads(before);
}

TEST_CASE("a step of a strategy allocates nothing", "[strategies]") {
  for (const bool consistent : {false, true}) {
    for (const std::string& strategy : iterations) {
      Chain chain({.n = 40, .consistent = consistent, .load = 0.01});
      Relaxing relaxing(chain, {.strategy = strategy, .options = {.omega_1 = 0.03}}, 0.5);
      relaxing.stepper->step(1e6);
      const long before = allocation_count();
      for (int k = 0; k < 30; ++k) relaxing.stepper->step(1e6);
      const long allocated = allocation_count() - before;
      CAPTURE(strategy, consistent);
      CHECK(allocated == 0);
    }
  }
}

TEST_CASE("what a strategy has found goes on from phase to phase, even where each step is one", "[strategies]") {
  // fire needs a direction that lasts: it takes phases of a few steps.
  const TemporaryFolder folder;
  const auto file = folder.write("column.toml", R"(dim = 2
[grid]
min = [0, 0]
max = [2, 10]
cells = [1, 8]
basis = "quadratic"
[body]
material = "soil"
points_per_cell = 4
[material.soil]
law = "hencky"
E = 5e6
nu = 0.3
rho = 1600
[phase]
max_motion = 0
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
[[support]]
face = "right"
kind = "roller"
[body_force]
value = [0, -9.81]
[stop]
residual = 1e-6
steps = 3000
)");
  for (const std::string strategy : {"adaptive", "papadrakakis", "auto", "fire2"}) {
    const std::string max_motion = strategy == "fire2" ? "0.0005" : "0";
    const Summary summary = run(load_scene(file, {override_of(strategy), "phase.max_motion=" + max_motion}));
    CAPTURE(strategy, summary.reason, summary.phases);
    CHECK(summary.status == RunStatus::equilibrium);
    CHECK(summary.phases > 100);
  }
}

TEST_CASE("every dynamic strategy relaxes a block that yields", "[strategies]") {
  const TemporaryFolder folder;
  const auto file = folder.write("block.toml", yielding_block);
  for (const std::string& strategy : iterations) {
    if (catalogue().static_method(strategy)) continue;
    const Summary summary = run(load_scene(file, {override_of(strategy)}));
    CAPTURE(strategy, summary.reason, summary.rhs_evaluations);
    CHECK(summary.status == RunStatus::equilibrium);
    CHECK(scenes::probe(summary, "middle", "stress.yy") == Approx(-28).epsilon(0.2));
  }
}

TEST_CASE("strategies relax a block that leans on a wall, whose nodes open and close", "[strategies]") {
  for (const std::string& strategy : iterations) {
    if (catalogue().static_method(strategy) || find_relaxation(strategy)->needs_omega_1) continue;
    const Summary summary = run(scenes::load(
        "block_on_wall", {override_of(strategy), "stop.residual=1e-6", "stop.time=0", "stop.steps=100000"}));
    CAPTURE(strategy, summary.reason, summary.rhs_evaluations);
    CHECK(summary.status == RunStatus::equilibrium);
  }
}

TEST_CASE("options that a relaxation or a damping does not go with are refused with a reason", "[strategies]") {
  Chain chain({.n = 3});
  const auto combined = make_damping("combined", 0, 0.5), none = no_damping();
  RelaxationSystem damped(chain, *combined), undamped(chain, *none);
  CHECK_THROWS_WITH(make_integrator({.method = "erk:rk4", .max_step = 0.1}, damped),
                    Catch::Contains("symplectic-euler"));
  CHECK_THROWS_WITH(make_relaxation({.name = "chebyshev", .max_step = 0.1}, undamped), Catch::Contains("omega_1"));
  CHECK_THROWS_WITH(make_relaxation({.name = "fire", .max_step = 0}, undamped), Catch::Contains("max_step"));
  CHECK_THROWS_WITH(make_relaxation({.name = "newton", .max_step = 0.1}, undamped), Catch::Contains("no relaxation"));
}
