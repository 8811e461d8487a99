// How runs end: each way has its status and its exit status.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "child.hpp"
#include "files.hpp"
#include "partial_files.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using scenes::bar;

namespace {

// Whose end is pushed past its beginning within 10 s.
std::vector<std::string> crushed_past_zero() {
  return {"material.bar.law=neo-hookean",
          "force=[]",
          "support=[{at=0.0}, {at=10.0, u='-t'}]",
          "damping.strategy=viscous",
          "damping.c=0.1",
          "output.every=1000",
          "stop.time=20",
          "stop.residual=0"};
}

}  // namespace

TEST_CASE("with only stop.time set, reaching it is success and the history's last row is at it") {
  const TemporaryFolder folder;
  for (const char* method : {"leapfrog", "erk:rk4", "gsl:rkf45"}) {
    const Summary s =
        run(bar({"stop.time=7.3", "stop.residual=0", "output.every=0.5", std::string("integrator.method=") + method}),
            {.out = folder.path()});
    CAPTURE(method);
    CHECK(s.status == RunStatus::end_time);
    CHECK(s.exit_status == 0);
    const auto history = lines(folder.path() / "history.csv");
    REQUIRE(history.size() == 1 + 1 + 15);  // header, t = 0, 0.5 … 7.0, 7.3
    CHECK(std::stod(history[1]) == 0);
    for (int k = 0; k <= 14; ++k) CHECK(std::stod(history[1 + k]) == 0.5 * k);
    CHECK(std::stod(history.back()) == 7.3);
  }
}

TEST_CASE("limits that come before equilibrium end the run with status 3 and keep the history") {
  const TemporaryFolder folder;
  const auto ends = [&](const std::vector<std::string>& overrides, RunStatus expected) {
    const Summary s = run(bar(overrides), {.out = folder.path()});
    CHECK(s.status == expected);
    CHECK(s.exit_status == 3);
    CHECK(json_of(folder.path() / "summary.json")["status"] == to_string(expected));
    CHECK(lines(folder.path() / "history.csv").size() >= 3);
  };
  ends({"stop.time=10"}, RunStatus::end_time);  // residual is still asked for
  ends({"stop.steps=50"}, RunStatus::step_limit);
  ends({"damping.strategy=none", "stop.wall_time=0.2"}, RunStatus::time_limit);
}

TEST_CASE("an unstable step is refused unless the scene says why, and then diverges with status 4") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  CHECK_THROWS_AS(run(bar({"integrator.step=0.36"}), {.out = out}), SceneError);
  CHECK_FALSE(std::filesystem::exists(out));
  for (const char* method : {"leapfrog", "symplectic-euler", "erk:rk4", "erk:dormand-prince-7-4-5", "gsl:rk4"}) {
    const Summary s =
        run(bar({"damping.strategy=none", "integrator.step=1.2", "output.every=1.2",
                 "integrator.unstable_reason=to see it diverge", std::string("integrator.method=") + method}),
            {.out = out});
    CAPTURE(method);
    CHECK(s.status == RunStatus::diverged);
    CHECK(s.exit_status == 4);
    CHECK_FALSE(s.reason.empty());
    CHECK(std::filesystem::exists(out / "history.csv"));
    CHECK_FALSE(leftovers(out));
  }
}

TEST_CASE("a bar crushed past zero length is reported as diverged, not as a number") {
  const Summary s = run(bar(crushed_past_zero()));
  CHECK(s.status == RunStatus::diverged);
  CHECK(s.exit_status == 4);
}

TEST_CASE("an interrupt finishes the step, writes what there is and says so") {
  const TemporaryFolder folder;
  int asked = 0;
  const Summary s =
      run(bar({"damping.strategy=none"}),
          {.out = folder.path(), .interrupted = [&] { return is_stepping(folder.path()) && ++asked == 100; }});
  CHECK(s.status == RunStatus::interrupted);
  CHECK(s.exit_status == 3);
  CHECK(s.steps == 100);
  CHECK(json_of(folder.path() / "summary.json")["status"] == "interrupted");
}

TEST_CASE("Ctrl-C ends the command in good order with status 3") {
  const TemporaryFolder folder;
  test::Child child({"run", STILLPOINT_PROBLEMS "/bar.toml", "--set", "damping.strategy=none", "--quiet", "--out",
                     folder.path().string()});
  CHECK(child.wait_until([&] {
    const auto history = folder.path() / "history.csv.partial";
    return std::filesystem::exists(history) && lines(history).size() > 2;
  }));
  child.send(SIGINT);
  CHECK(child.wait() == 3);
  CHECK(json_of(folder.path() / "summary.json")["status"] == "interrupted");
  CHECK(lines(folder.path() / "history.csv").size() > 2);
  CHECK_FALSE(leftovers(folder.path()));
}

TEST_CASE("a failed run reports its last good state, the same in summary and history") {
  const TemporaryFolder folder;
  const Summary s = run(bar(crushed_past_zero()), {.out = folder.path()});
  CHECK(s.status == RunStatus::diverged);
  const auto history = lines(folder.path() / "history.csv");
  REQUIRE(history.size() == 3);
  CHECK(std::stod(history.back()) == s.t);
  CHECK(s.kinetic_energy > 0);
  CHECK(scenes::probe(s, "p12", "stress") != 0);
}

TEST_CASE("a body that starts in equilibrium is found to be in it after one period") {
  const Summary s = run(bar({"initial.u=P0*x", "stop.steps=5000"}));
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.t < 50);
}

TEST_CASE("a body unloaded to nothing is found at rest") {
  for (const auto& overrides : std::vector<std::vector<std::string>>{
           {"force=[]", "initial.u=0.01*x"},
           {"force=[{at=10.0, value='P0*max(0, 1-t/10)'}]", "stop.time=2000"},
           {"force=[{at=10.0, value='P0*sin(pi*min(t/10, 1))^2'}]", "stop.time=2000"}}) {  // 1.5e-32 P0 in the end
    std::vector<std::string> all{"stop.residual=1e-6", "damping.strategy=viscous", "damping.c=critical"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const Summary s = run(bar(all));
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.t < 250);
  }
}

TEST_CASE("equilibrium is not declared before a delayed load has acted") {
  const Summary s = run(bar({"force=[{at=10.0, value='P0*(t>200)'}]", "stop.time=1000"}));
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.t > 200);
  CHECK(s.error->u_rel_max < 1e-8);
  const auto says = [](const Summary& of) {
    return std::ranges::any_of(
        of.notes, [](const std::string& note) { return note.find("stop.time is not set") != std::string::npos; });
  };
  const Summary open = run(bar({"force=[{at=10.0, value='P0*(t>200)'}]"}));
  CHECK(open.status == RunStatus::equilibrium);
  CHECK(open.t > 200);
  CHECK_FALSE(says(open));
  CHECK(says(run(bar({"force=[{at=10.0, value='P0*(1 + 1e-9*t)'}]", "stop.residual=1e-6"}))));  // which never ends
}

TEST_CASE("an initial state that cannot be evaluated or is unstable is refused before anything is written") {
  CHECK_THROWS_WITH(make_model(bar({"material.bar.law=neo-hookean", "initial.u=-2*x"})),
                    Catch::Contains("cannot be evaluated"));
}

TEST_CASE("the residual of a failed run is that of its last good state, not of the trial that failed") {
  const Summary s = run(bar(crushed_past_zero()));
  REQUIRE(s.status == RunStatus::diverged);
  CHECK(std::isfinite(s.residual));
}

TEST_CASE("a body that yields under a load that grows is found at rest once the load has come to its end") {
  for (const std::string pull : {"body_force.value=[0, '-g*min(t/0.5, 1)']",
                                 "support=[{face='bottom', kind='roller', u='-0.1*min(t/0.5, 1)'},"
                                 "{face='left', kind='roller'}, {face='right', kind='roller'}]"}) {
    const Summary s = run(scenes::load(
        "column", {"material.soil={law='drucker-prager', E=2e7, nu=0.2, rho=2000, phi=20, c=1000}", "grid.cells=[1, 8]",
                   "phase.max_motion=none", "stop.time=10", "stop.residual=1e-6", pull}));
    CAPTURE(pull, s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.t > 0.5);
    CHECK(s.t < 5);
  }
}
