// Cases that ordinary explicit runs lose.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"

using namespace stillpoint;

namespace {

Summary rubber(std::vector<std::string> overrides) { return run(scenes::load("neo_hookean_bar", overrides)); }

}  // namespace

TEST_CASE("a neo-Hookean bar stretched to 2 and 5 times its length relaxes to the exact answer") {
  for (const char* F : {"2", "5"}) {
    const Summary s = rubber({std::string("constants.F=") + F});
    CAPTURE(F);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.error->u_rel_max < 1e-8);
    CHECK(*s.error->stress_rel_l2 < 1e-8);
  }
}

TEST_CASE("a bar crushed at a stroke to 40 % of its length relaxes: the step follows the stiffening") {
  for (const char* method : {"leapfrog", "erk:rk4", "erk:bogacki-shampine-4-2-3"}) {
    std::vector<std::string> overrides{"constants.F=0.4", std::string("integrator.method=") + method};
    if (std::string(method) == "erk:bogacki-shampine-4-2-3") overrides.push_back("integrator.rtol=1e-3");
    const Summary s = rubber(overrides);
    CAPTURE(method);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.error->u_rel_max < 1e-8);
  }
}

TEST_CASE("a bar crushed at a stroke to a tenth of its length relaxes: trials that are inside out are tried shorter") {
  for (const char* method : {"leapfrog", "erk:rk4", "erk:bogacki-shampine-4-2-3"}) {
    for (const char* fraction : {"0.9", "0.8"}) {
      std::vector<std::string> overrides{"constants.F=0.1", std::string("integrator.method=") + method,
                                         std::string("integrator.step_fraction=") + fraction, "stop.steps=50000"};
      if (std::string(method) == "erk:bogacki-shampine-4-2-3") overrides.push_back("integrator.rtol=1e-3");
      const Summary s = rubber(overrides);
      CAPTURE(method, fraction, s.reason);
      CHECK(s.status == RunStatus::equilibrium);
      CHECK(s.error->u_rel_max < 1e-8);
    }
  }
}

TEST_CASE(
    "a bar crushed at a stroke comes to rest whatever the last digits of its load: the step does not swing with it") {
  for (const char* F : {"0.1001", "0.1002", "0.1003", "0.1008"}) {
    const Summary s = rubber({std::string("constants.F=") + F, "stop.steps=50000"});
    CAPTURE(F, s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.error->u_rel_max < 1e-8);
  }
}

TEST_CASE("rows that nobody asked for shorten no step that follows the stiffness") {
  // A row was due every step, or every third: a step a tenth shorter became half as long, or three quarters.
  for (const char* scene : {"hard/pulled_in_phases", "hard/column_in_phases"}) {
    const auto steps = [&](const std::vector<std::string>& more) {
      std::vector<std::string> overrides = {"phase.max_motion=none", "stop.residual=0", "stop.steps=1000000",
                                            "stop.time=20"};
      if (std::string(scene) == "hard/column_in_phases") overrides.emplace_back("grid.cells=16");
      overrides.insert(overrides.end(), more.begin(), more.end());
      return run(scenes::load(scene, overrides)).steps;
    };
    const long few_rows = steps({"output.every=20"});
    CAPTURE(scene, few_rows);
    CHECK(few_rows > 50);
    CHECK(std::abs(steps({}) - few_rows) <= 1);
  }
}

TEST_CASE(
    "a bar under a force that crushes it to a hundredth of its length relaxes to the exact answer, or says where") {
  // P = μ (F − 1/F) with E = 1, ν = 0, so that μ = ½ and the section stays
  const Summary s = run(
      scenes::bar({"material.bar.law=neo-hookean", "force=[{at=10.0, value=-50.0}]", "stop.steps=100000", "exact={}"}));
  const double F = -50 + std::sqrt(50 * 50 + 1);
  CAPTURE(s.reason);
  // Which of the two a rounding decides.
  if (s.status == RunStatus::equilibrium) {
    CHECK(scenes::probe(s, "p12", "u") == Approx((F - 1) * 115 / 12).epsilon(1e-6));
  } else {
    CHECK(s.exit_status == 4);
    CHECK_THAT(s.reason, Catch::Contains("det f = ") && Catch::Contains("at material point "));
  }
}

TEST_CASE("a damping of any size leaves a run a step, and what is too strong to end is said to be") {
  for (const char* method : {"leapfrog", "symplectic-euler", "erk:rk4", "erk:jameson-5-2", "gsl:rk4"}) {
    for (const char* c : {"1e6", "1e12", "1e300"}) {
      const Summary s =
          run(scenes::load("hard/cut_bar", {"constants.sliver=0", "stop.steps=500", std::string("damping.c=") + c,
                                            std::string("integrator.method=") + method}));
      CAPTURE(method, c, s.reason);
      CHECK(s.status == RunStatus::step_limit);
      CHECK(s.dt > 0);
      REQUIRE_FALSE(s.notes.empty());
      CHECK_THAT(s.notes.back(), Catch::Contains("times the critical damping") && Catch::Contains("stop.steps is 500"));
    }
  }
  CHECK(run(scenes::load("hard/cut_bar", {"constants.sliver=0", "stop.steps=5000"})).notes.empty());
}

TEST_CASE("a free bar under a force in balance finds its shape, though it has no lowest frequency") {
  const Summary s = run(scenes::bar({"support=[]", "force=[{at=0.0, value=-0.001}, {at=10.0, value=0.001}]",
                                     "damping.strategy=cundall", "stop.residual=1e-8"}));
  CHECK(s.status == RunStatus::equilibrium);
  CHECK_FALSE(s.omega_1);
  CHECK(scenes::probe(s, "p12", "stress") == Approx(0.001).epsilon(1e-6));
  CHECK(scenes::probe(s, "p12", "u") - scenes::probe(s, "p6", "u") == Approx(0.005).epsilon(1e-6));
}

TEST_CASE("critical damping of a body that is not held is refused at its key") {
  CHECK_THROWS_WITH(run(scenes::bar({"support=[]", "force=[]", "damping.c=critical"})),
                    Catch::Contains("damping.c") && Catch::Contains("not held"));
}

TEST_CASE("an adaptive run at a loose tolerance reaches equilibrium: the stability cap keeps it from stalling") {
  for (const char* method : {"erk:bogacki-shampine-4-2-3", "erk:dormand-prince-7-4-5"}) {
    const Summary s = run(scenes::bar({std::string("integrator.method=") + method, "integrator.rtol=1e-3",
                                       "damping.strategy=viscous", "damping.c=critical", "stop.steps=20000"}));
    CAPTURE(method);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.error->u_rel_max < 1e-8);
  }
}

TEST_CASE("random points give the exact bar wherever their volumes integrate degree 2, and a note wherever not") {
  int exact = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    const Scene scene =
        scenes::bar({"body.placement=random", "body.points_per_cell=10", "body.seed=" + std::to_string(seed)});
    const Model model = make_model(scene);
    CHECK_FALSE(model.notes.empty());  // a Hermite cubic wants degree 4
    if (model.phase->shape().discretisation().quadrature.degree < 2) continue;
    CAPTURE(seed);
    const Summary s = run(scene);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.error->u_rel_max < 1e-8);
    ++exact;
  }
  CHECK(exact >= 3);
}

TEST_CASE("an adaptive step is capped by the stability limit whatever integrator.step says, unless a reason is given") {
  const Summary s =
      run(scenes::bar({"integrator.method=erk:dormand-prince-7-4-5", "integrator.rtol=1e-3", "integrator.step=100",
                       "damping.strategy=viscous", "damping.c=critical", "stop.steps=20000"}));
  CHECK(s.status == RunStatus::equilibrium);
}

TEST_CASE("a face that misses a grid line by a sliver does not shorten the step, and is noted") {
  const std::vector<std::string> base{"grid.basis=linear", "mass.kind=lumped", "grid.cells=4",
                                      "probe=[]",          "force=[]",         "traction=[{face='right', value='P0'}]"};
  const auto with_end = [&](const std::string& end) {
    std::vector<std::string> overrides = base;
    overrides.push_back("body.max=" + end);
    return make_model(scenes::bar(overrides));
  };
  const Model whole = with_end("7.5");
  CHECK(*with_end("7.5000001").critical_step == Approx(*whole.critical_step).epsilon(1e-6));
  CHECK(whole.notes.empty());
  const Model sliver = with_end("7.51");
  CHECK(*sliver.critical_step == Approx(*whole.critical_step).epsilon(0.05));
  CHECK_THAT(sliver.notes.at(0), Catch::Contains("hardly reaches"));
}

TEST_CASE("without tolerances from the user an adaptive run is as accurate as rtol says, on coarse and fine grids") {
  for (const char* cells : {"4", "60"}) {
    for (const char* rtol : {"1e-4", "1e-6", "1e-8"}) {
      const auto u_end = [&](const std::vector<std::string>& overrides) {
        std::vector<std::string> all{"damping.strategy=viscous",
                                     "stop.time=20",
                                     "stop.residual=0",
                                     "output.every=20",
                                     "probe=[{name='end', at=10.0, fields=['u']}]",
                                     std::string("grid.cells=") + cells,
                                     "integrator.method=erk:dormand-prince-7-4-5"};
        all.insert(all.end(), overrides.begin(), overrides.end());
        return scenes::probe(run(scenes::bar(all)), "end", "u");
      };
      const double reference = u_end({"integrator.rtol=1e-11", "integrator.atol_u=1e-14", "integrator.atol_v=1e-14"});
      CAPTURE(cells, rtol);
      CHECK(std::abs(u_end({std::string("integrator.rtol=") + rtol}) / reference - 1) < std::stod(rtol));
    }
  }
}

TEST_CASE("auto follows a load that turns round once the body has come to rest, whenever that is") {
  // What is left of the motion is rounding then: the load's jump beside it is no stiffness.
  for (int time = 260; time <= 330; time += 10) {
    const Summary s = run(scenes::load(
        "hard/load_that_changes", {fmt::format("force[0].value=P0*(1 - 2*(t < {}))", time), "damping.strategy=auto"}));
    CAPTURE(time, s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    REQUIRE(s.error);
    CHECK(s.error->u_rel_l2 < 1e-6);
  }
}
