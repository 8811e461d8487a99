// What a run that goes wrong says: when, where, which quantity, what to try.
#include <limits>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "free_block.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Contains;
using Catch::Matches;
using scenes::bar;

namespace {

// A bar whose end is pushed past its beginning: no step is short enough.
std::vector<std::string> crushed_by(const std::string& method) {
  return {"material.bar.law=neo-hookean",
          "force=[]",
          "support=[{at=0.0}, {at=10.0, u='-0.2*t'}]",
          "damping.strategy=viscous",
          "damping.c=0.1",
          "stop.residual=0",
          "stop.time=60",
          "integrator.method=" + method};
}

std::string refusal_of_state(const LagrangianPhase& phase, std::vector<double> u) {
  const auto trial = phase.make_trial();
  std::vector<double> R(phase.size());
  REQUIRE_FALSE(phase.internal_force(0, u, R, *trial));
  return phase.diagnosis().refusal(*trial);
}

}  // namespace

TEST_CASE("a state that cannot be evaluated is told with its time, step, point, cell, det f and a remedy") {
  const stillpoint::test::TemporaryFolder folder;
  for (const char* method : {"leapfrog", "symplectic-euler", "erk:rk4", "gsl:rk4"}) {
    const Summary s = run(bar(crushed_by(method)), {.out = folder.path()});
    CAPTURE(method, s.reason);
    CHECK(s.status == RunStatus::diverged);
    CHECK_THAT(s.reason, Matches("at t = \\d.* s, after \\d+ steps, in phase 1: .*material point \\d+ at x = \\S+ in "
                                 "cell \\d.*expected .*"));
    CHECK_THAT(s.reason, Contains("det f = -") && Contains("after 10 halvings"));
    // The last good state is there.
    const std::string history = test::contents(folder.path() / "history.csv");
    CHECK(std::stod(history.substr(history.rfind('\n', history.size() - 2) + 1)) == s.t);
  }
}

TEST_CASE("of several points that are inside out the one is named that is so most, with the number of the others") {
  const Model model = make_model(bar({"material.bar.law=neo-hookean"}));
  std::vector<double> u = model.phase->initial_displacement(0);
  for (double& value : u) value = 0;
  // The value at x = 5 goes to -20: 2.5 to 5 is turned inside out, and most in the middle.
  std::size_t middle = u.size();
  for (std::size_t k = 0; k < u.size(); ++k) {
    const PlaceInBody place = model.phase->diagnosis().of_unknown(k);
    if (place.position.at(0) == 5 && middle == u.size()) middle = k;
  }
  REQUIRE(middle < u.size());
  u[middle] = -20;
  const std::string said = refusal_of_state(*model.phase, u);
  CAPTURE(said);
  CHECK_THAT(said, Contains("material point 5 at x = 3.75 in cell 2"));
  CHECK_THAT(said, Contains("det f = -11 <= 0") && Contains("other points"));
}

TEST_CASE("a motion too far for one phase is told with the node that goes furthest") {
  const Model model = make_model(stillpoint::test::free_block());
  std::vector<double> u(model.phase->size(), 0.0);
  u[3] = 1;
  const std::string said = refusal_of_state(*model.phase, u);
  CHECK_THAT(said, Contains(to_string(model.phase->diagnosis().of_unknown(3))) && Contains("would move by 1 m") &&
                       Contains("expected a smaller integrator.step_fraction"));
}

TEST_CASE("a law that gives no number is told with the component of the stress, the point and the material") {
  const Model model = make_model(scenes::load("column", {"material.soil={law='hencky', E=1e7, nu=0.2, rho=2000}"}));
  std::vector<double> u(model.phase->size(), 0.0);
  u[0] = std::numeric_limits<double>::max();
  const std::string said = refusal_of_state(*model.phase, u);
  CAPTURE(said);
  CHECK_THAT(said, Matches(".*material point \\d+ at \\(.*\\) in cell \\(\\d+, \\d+\\).*"));
}

TEST_CASE("a formula that is no number on the way is told with its key, the time and the point") {
  const Summary s = run(bar({"force=[]", "body_force.value=[\"1e-4*sqrt(40 - t - x)\"]"}));
  CAPTURE(s.reason);
  CHECK(s.status == RunStatus::diverged);
  CHECK_THAT(s.reason, Matches("at t = 30.*body_force.value is not a number at t = 30.5 at material point 12 at x = "
                               "9.58333 in cell 4; expected a finite number.*"));
  const Summary infinite = run(bar({"force[0].value=P0/(t > 20)"}));
  CHECK(infinite.status != RunStatus::equilibrium);
  CHECK_THAT(infinite.reason, Contains("force[0].value is"));
}

TEST_CASE("a motion that grows beyond all numbers is told with the node that was fastest") {
  for (const char* method : {"leapfrog", "symplectic-euler", "erk:rk4", "gsl:rk4"}) {
    const Summary s =
        run(bar({"damping.strategy=none", "integrator.step=1.2", "output.every=1.2",
                 "integrator.unstable_reason=to see it diverge", std::string("integrator.method=") + method}));
    CAPTURE(method, s.reason);
    CHECK(s.status == RunStatus::diverged);
    CHECK_THAT(s.reason, Matches(".*fastest, \\S+ m/s, at the node at x = \\S+ beside material point \\d+ in cell "
                                 "\\d.*expected a smaller step.*"));
  }
}

TEST_CASE("a limit that comes before equilibrium is told with where the body is furthest from it") {
  for (const std::string limit : {"stop.steps=50", "stop.time=10"}) {
    const Summary s = run(bar({limit}));
    CAPTURE(limit, s.reason);
    CHECK(s.exit_status == 3);
    CHECK_THAT(s.reason, Contains("the out-of-balance force is largest at the node at x =") && Contains("fastest,"));
  }
  // Where the end of time is all that was asked for there is nothing to tell.
  CHECK_THAT(run(bar({"stop.residual=0", "stop.time=10"})).reason, !Contains("out-of-balance"));
}

TEST_CASE("a static solver that comes no nearer tells where the residual is largest") {
  for (const std::string method : {"newton", "cg", "lbfgs"}) {
    const Summary s = run(bar({"solve.method=" + method, "stop.residual=1e-30", "material.bar.law=neo-hookean",
                               "stop.steps=300", "damping={}"}));
    CAPTURE(method, s.reason);
    CHECK(s.exit_status != 0);
    CHECK_THAT(s.reason, Contains("largest at the node at x ="));
  }
}
