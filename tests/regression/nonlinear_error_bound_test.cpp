// Where stiffness changes the error bound is an estimate, by the tangent at the end.
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "distance_to_rest.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

struct EndOfRun {
  Summary summary;
  Values u;
  std::shared_ptr<const LagrangianPhase> phase;  // for its mass
};
EndOfRun ended(const Scene& scene) {
  EndOfRun result;
  result.phase = make_phase(scene);
  Simulation simulation(scene);
  simulation.run();
  result.summary = simulation.summary();
  result.u.assign(simulation.u().begin(), simulation.u().end());
  return result;
}

double error_at_end(const EndOfRun& end, const Values& rest) {
  return relative_difference(end.phase->mass(), end.u, rest);
}

const Case soft_column{
    "column", {"material.soil.law=neo-hookean", "constants.E=784800", "phase.max_motion=none"}};  // ρ g H = E/4
const Case short_cantilever{"cantilever", {"grid.cells=[10, 1]", "body.points_per_cell=4", "constants.h=1.0"}};
const Case small_footing{"footing", {"grid.cells=[12, 9]"}};

}  // namespace

TEST_CASE("relaxation and Newton's method agree to the error bound at large strain", "[error bound]") {
  for (const Case& problem : {soft_column, short_cantilever}) {
    const Values rest = equilibrium_of(with(problem, "viscous"));
    for (const std::string strategy : {"viscous", "auto", "kinetic"}) {
      const EndOfRun end = ended(with(problem, strategy, {"stop.residual=1e-5"}));
      REQUIRE(end.summary.status == RunStatus::equilibrium);
      REQUIRE(end.summary.distance);
      const double error = error_at_end(end, rest), ratio = *end.summary.distance / error;
      CAPTURE(problem.name, strategy, error, ratio);
      CHECK(ratio > 0.9);
      CHECK(ratio < 30);  // 1 where the slowest mode is left, more where a reset of v leaves others
    }
  }
}

TEST_CASE("relaxation and Newton's method agree to the error bound where soil yields without any overshoot",
          "[error bound]") {
  // Strains of 1e-4, so that places hardly move; more than critical damping, so that stresses only ever grow.
  const Scene scene =
      scenes::load("column", {"phase.max_motion=none", "damping.c=500", "stop.residual=1e-6",
                              "material.soil={law='drucker-prager', E=2e9, nu=0.2, rho=2000, phi=20, psi=20, c=1000}"});
  const EndOfRun end = ended(scene);
  REQUIRE(end.summary.status == RunStatus::equilibrium);
  REQUIRE(end.summary.distance);
  const double error = error_at_end(end, equilibrium_of(scene)), ratio = *end.summary.distance / error;
  CAPTURE(error, ratio);
  CHECK(ratio > 0.5);
  CHECK(ratio < 20);
}

// An elastic tangent says nothing of what still yields on the way: here the distance is an estimate, down to 0.6 times
// the error with critical damping.
TEST_CASE("where ground yields the distance is that to the equilibrium that the same run comes to later",
          "[error bound]") {
  for (const std::string strategy : {"viscous", "kinetic", "one-sided"}) {
    const EndOfRun end = ended(with(small_footing, strategy, {"stop.residual=1e-4"}));
    const EndOfRun later = ended(with(small_footing, strategy, {"stop.residual=1e-10"}));
    REQUIRE(later.summary.status == RunStatus::equilibrium);
    REQUIRE(end.summary.distance);
    const double error = error_at_end(end, later.u), ratio = *end.summary.distance / error;
    CAPTURE(strategy, error, ratio);
    CHECK(ratio > 0.5);
    CHECK(ratio < 20);
  }
}

// With a consistent mass local damping may turn forces into higher modes: this motion grows by 1e8, and comes back.
TEST_CASE("a step that is not stable makes no equilibrium by the size of what it blew up", "[error bound]") {
  const Scene scene = with({"hard/blown_up", {"stop.steps=20000"}}, "one-sided");
  const EndOfRun end = ended(scene);
  const Values rest = equilibrium_of(scenes::load("hard/blown_up", {"support=[{face='bottom'}, {face='top', "
                                                                    "kind='roller', u=-0.0005386}]"}));
  CAPTURE(end.summary.reason);
  CHECK((end.summary.exit_status != 0 || error_at_end(end, rest) < 0.01));
}

// A small residual is one beside the stiff bar's forces.
TEST_CASE("Newton's methods go on until a soft bar beside a stiff one is right as well", "[error bound]") {
  const std::vector<std::string> large_strain = {"material.soft.law=hencky", "material.stiff.law=hencky",
                                                 "phase.max_motion=none",
                                                 "force=[{at=6, value=1e6}, {at=9, value=-1e6}, {at=10, value=0.3}]"};
  for (const std::vector<std::string>& overrides : {std::vector<std::string>{}, large_strain}) {
    const Case problem{"hard/soft_and_stiff", overrides};
    const Values rest = equilibrium_of(with(problem, "viscous"));
    for (const std::string method : {"newton", "newton-cg"}) {
      for (const std::string residual : {"stop.residual=1e-3", "stop.residual=1e-4", "stop.residual=1e-6"}) {
        const EndOfRun end = ended(with(problem, method, {residual}));
        CAPTURE(overrides.size(), method, residual, end.summary.reason);
        CHECK(end.summary.status == RunStatus::equilibrium);
        CHECK(error_at_end(end, rest) <= 1e-3);
      }
    }
  }
}

// P = E ln F/F of the soft bar is E/e at most.
TEST_CASE("a static solver finds no equilibrium of a soft bar under more than it can bear, whatever a stiff one bears",
          "[error bound]") {
  for (const std::string method : {"newton", "newton-cg", "cg", "lbfgs"}) {
    const EndOfRun end = ended(with({"hard/soft_and_stiff",
                                     {"material.soft.law=hencky", "material.stiff.law=hencky", "phase.max_motion=none",
                                      "force=[{at=6, value=1e6}, {at=9, value=-1e6}, {at=10, value=0.6}]"}},
                                    method));
    CAPTURE(method, end.summary.reason);
    CHECK((end.summary.status == RunStatus::failed || end.summary.status == RunStatus::unstable_equilibrium));
    CHECK(end.summary.exit_status != 0);
  }
}

TEST_CASE("a run that stops by the distance alone is in equilibrium and no further off than was asked",
          "[error bound]") {
  for (const Case& problem : {linear_scenes[0], linear_scenes[2], linear_scenes[4]}) {
    const Values rest = equilibrium_of(with(problem, "viscous"));
    for (const std::string strategy : {"viscous", "kinetic", "one-sided", "auto"}) {
      const double wanted = 1e-4;
      const EndOfRun end = ended(with(problem, strategy, {"stop.residual=0", "stop.distance=1e-4", "stop.hold=0"}));
      CAPTURE(problem.name, strategy, end.summary.reason);
      CHECK(end.summary.status == RunStatus::equilibrium);
      CHECK(end.summary.exit_status == 0);
      CHECK_THAT(end.summary.reason, Catch::Contains("distance"));
      CHECK(end.summary.distance.value() <= wanted);
      CHECK(end.summary.distance.value() > 0);
      CHECK(error_at_end(end, rest) <= wanted * (1 + wanted));
      // And it did not go on until there was nothing left, which auto does on the chain in the step that is near
      // enough.
      if (strategy != "auto") CHECK(end.summary.residual > 1e-9);
    }
  }
}

TEST_CASE("of a body that stiffens the run stops by the distance with the tangent that it then has", "[error bound]") {
  const Scene scene = with(soft_column, "viscous", {"stop.residual=0", "stop.distance=1e-4", "stop.hold=0"});
  const EndOfRun end = ended(scene);
  CHECK(end.summary.status == RunStatus::equilibrium);
  CHECK(end.summary.distance.value() <= 1e-4);
  CHECK(error_at_end(end, equilibrium_of(scene)) <= 1e-4);
}
