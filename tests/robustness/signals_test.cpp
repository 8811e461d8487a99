// Whenever a run is to end, it ends in good order: in the set-up, in a step, between phases, while it writes, in the
// tests at its end.
#include <algorithm>
#include <csignal>
#include <optional>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "child.hpp"
#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::Child;
using stillpoint::test::contents;
using stillpoint::test::json_of;
using stillpoint::test::run_of;
using stillpoint::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

#ifdef STILLPOINT_SANITIZED
constexpr double soon = 10;
#else
constexpr double soon = 2;  // [s] of the processor's time
#endif
const std::string header = "t,steps,rhs_evaluations,residual,kinetic_energy\n";

// A set-up of many seconds.
const std::vector<std::string> large_run = {"grid.cells=[300, 300]", "grid.basis=quadratic"};

void check_good_order(Child& child, const fs::path& out) {
  const double before = child.seconds();
  CHECK(child.wait() == 3);
  CHECK(child.seconds() - before < soon);
  CHECK(json_of(out / "summary.json")["status"] == "interrupted");
  const std::string history = contents(out / "history.csv");
  CHECK(history.starts_with("t,steps"));
  CHECK(history.back() == '\n');
  for (const auto& entry : fs::directory_iterator(out)) CHECK(entry.path().extension() != ".partial");
}

// Its events as a run sees them, so that a test interrupts it exactly there.
struct Interrupted {
  std::optional<Simulation> simulation;
  template <class When>
  Summary run(const Scene& scene, const When& when) {
    simulation.emplace(scene, SimulationOptions{.interrupted = [&] { return simulation && when(*simulation); }});
    simulation->run();
    return simulation->summary();
  }
};

}  // namespace

TEST_CASE("a signal during the set-up ends it soon, whatever it is at, with a summary that says so") {
  for (const double after : {-1.0, 0.1, 0.7, 1.5, 2.5}) {
    for (const int signal : {SIGTERM, after < 1 ? SIGINT : SIGHUP}) {
      const TemporaryFolder folder;
      Child child(run_of("inclusion", large_run, folder.path()), {}, "/dev/null");
      CAPTURE(signal, after);
      // [s]; -1: as soon as it watches for signals.
      CHECK(child.wait_until([&] { return child.seconds() > after && child.heeds(signal); }));
      CHECK_FALSE(fs::exists(folder.path() / "history.csv.partial"));
      child.send(signal);
      check_good_order(child, folder.path());
      CHECK(json_of(folder.path() / "summary.json")["reason"] ==
            "interrupted by the user in the set-up; the run has not begun");
      CHECK(contents(folder.path() / "history.csv") == header);
    }
  }
}

TEST_CASE("stop.wall_time ends a set-up that takes longer") {
  const TemporaryFolder folder;
  std::vector<std::string> set = large_run;
  set.emplace_back("stop.wall_time=0.5");
  Child child(run_of("inclusion", set, folder.path()), {}, "/dev/null");
  CHECK(child.wait() == 3);
  CHECK(child.seconds() < 0.5 + soon);
  const auto summary = json_of(folder.path() / "summary.json");
  CHECK(summary["status"] == "time-limit");
  CHECK_THAT(summary["reason"].get<std::string>(),
             Catch::Contains("of wall time reached stop.wall_time in the set-up"));
  CHECK(summary["steps"] == 0);
}

TEST_CASE("a run that is interrupted in its set-up leaves nothing of an earlier one, and one that goes on all of it") {
  const Scene scene =
      scenes::load("block_on_wall", {"stop.steps=60", "checkpoint.every_steps=20", "output.stages=[0]"});
  const TemporaryFolder folder;
  run(scene, {.out = folder.path()});
  const fs::path checkpoint = folder.path() / "checkpoint.h5";
  std::map<std::string, std::string> before;
  for (const char* name : {"history.csv", "fields.h5", "fields.xdmf", "checkpoint.h5", "checkpoint-previous.h5"})
    before[name] = contents(folder.path() / name);
  const auto at_once = [] { return true; };
  const Summary resumed = run(scene, {.out = folder.path(), .resume = checkpoint, .interrupted = at_once});
  CHECK(resumed.status == RunStatus::interrupted);
  CHECK(resumed.exit_status == 3);
  for (const auto& [name, bytes] : before) CHECK((contents(folder.path() / name) == bytes));
  CHECK(json_of(folder.path() / "summary.json")["status"] == "interrupted");
  CHECK(run(scene, {.out = folder.path(), .resume = checkpoint}).steps == 60);

  CHECK(run(scene, {.out = folder.path(), .interrupted = at_once}).status == RunStatus::interrupted);
  CHECK(contents(folder.path() / "history.csv") == header);
  for (const char* name : {"fields.h5", "fields.xdmf", "checkpoint.h5"}) CHECK_FALSE(fs::exists(folder.path() / name));
  CHECK_THROWS_AS(Simulation(scene, {.interrupted = at_once}), SetUpStopped);
}

TEST_CASE("a signal between phases, or while fields are written, ends the run in good order") {
  const std::vector<std::string> in_phases = {"grid.cells=[120, 50]", "phase.max_motion=0", "output.stages=[]"};
  const std::vector<std::string> writing = {"grid.cells=[120, 50]", "output.stages=[]", "output.fields_every=1e-5"};
  for (const auto* set : {&in_phases, &writing}) {
    for (const int signal : {SIGTERM, SIGHUP}) {
      const TemporaryFolder folder;
      Child child(run_of("slope", *set, folder.path()), {}, "/dev/null");
      CHECK(child.wait_until([&] { return fs::exists(folder.path() / "history.csv.partial"); }));
      const double begun = child.seconds();
      CHECK(child.wait_until([&] { return child.seconds() > begun + 0.3; }));
      child.send(signal);
      check_good_order(child, folder.path());
      CHECK(json_of(folder.path() / "summary.json")["steps"] > 0);
      CHECK((set == &in_phases || fs::exists(folder.path() / "fields.h5")));
    }
  }
}

TEST_CASE("a second signal ends the process at once") {
  const TemporaryFolder folder;
  Child child(run_of("slope", {"grid.cells=[120, 50]", "output.stages=[]", "output.fields_every=1e-6"}, folder.path()));
  CHECK(child.wait_until([&] { return fs::exists(folder.path() / "fields.partial" / "frame_0020.h5"); }));
  child.send(SIGTERM);
  usleep(1000);
  child.send(SIGTERM);
  const auto status = child.wait();
  CHECK((!status || status == 3));  // 3: it was quicker
}

TEST_CASE("an interrupt within Newton's method ends it at the last equilibrium on its way, which can be gone on from") {
  const Scene scene = scenes::load("cantilever", {"solve.method=newton"});
  int asked = 0;
  Interrupted interrupted;
  const Summary s = interrupted.run(scene, [&](const Simulation&) { return ++asked == 3; });
  CHECK(s.status == RunStatus::interrupted);
  CHECK(s.reason == "interrupted by the user; the step was not finished");
  CHECK(s.exit_status == 3);
  CHECK(std::ranges::all_of(interrupted.simulation->u(), [](double u) { return u == 0; }));
  CHECK(s.residual > 0.1);
}

TEST_CASE("an equilibrium whose stability is not known, as the test was interrupted, is none") {
  const Scene scene = scenes::load("hard/strut");
  REQUIRE(run(scene).status == RunStatus::unstable_equilibrium);
  const Summary s =
      Interrupted().run(scene, [](const Simulation& now) { return now.status() == RunStatus::equilibrium; });
  CHECK(s.status == RunStatus::interrupted);
  CHECK_THAT(s.reason, Catch::Contains("before it was known whether the equilibrium is stable"));
  CHECK(s.stability.empty());
  CHECK(s.exit_status == 3);
}

TEST_CASE("rows of the history are there within seconds, and stay if the process is killed") {
  const TemporaryFolder folder;
  const fs::path history = folder.path() / "history.csv.partial";
  Child child(run_of("bar", {"damping.strategy=none"}, folder.path()), {}, "/dev/null");
  const auto rows = [&] { return fs::exists(history) ? std::ranges::count(contents(history), '\n') : 0; };
  CHECK(child.wait_until([&] { return rows() > 10; }));
  const auto before = rows();
  CHECK(child.wait_until([&] { return rows() > before; }));
  child.send(SIGKILL);
  child.wait();
  CHECK(rows() > before);
  CHECK(contents(history).back() == '\n');
}
