// How runs end: each way has its status, its exit status and its files.
#include <csignal>
#include <sstream>

#include <catch2/catch.hpp>

#include "child.hpp"
#include "files.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using scenes::bar;
using stillpoint::test::contents;
using stillpoint::test::json_of;
using stillpoint::test::TemporaryFolder;

namespace {

std::vector<std::string> lines(const std::filesystem::path& file) {
  std::vector<std::string> result;
  std::istringstream text(contents(file));
  for (std::string line; std::getline(text, line);) result.push_back(line);
  return result;
}

// Whose end is pushed past its beginning within 10 s.
std::vector<std::string> crushed() {
  return {"material.bar.law=neo-hookean",
          "force=[]",
          "support=[{at=0.0}, {at=10.0, u='-t'}]",
          "damping.strategy=viscous",
          "damping.c=0.1",
          "output.every=1000",
          "stop.time=20",
          "stop.residual=0"};
}

bool is_stepping(const std::filesystem::path& out) { return std::filesystem::exists(out / "history.csv.partial"); }

bool leftovers(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".partial") return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a run writes its summary and history whole, with every key of the contract") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "new" / "out";
  const Summary s = run(bar(), {.out = out});
  CHECK(s.exit_status == 0);
  CHECK_FALSE(leftovers(out));
  const auto json = json_of(out / "summary.json");
  for (const char* key : {"scene",
                          "status",
                          "t",
                          "steps",
                          "rhs_evaluations",
                          "phases",
                          "points",
                          "dofs",
                          "threads",
                          "wall_s",
                          "ns_per_point_step",
                          "residual",
                          "distance",
                          "stability",
                          "unstable_omega_squared",
                          "kinetic_energy",
                          "omega_1",
                          "omega_max",
                          "c",
                          "dt",
                          "error",
                          "probes",
                          "versions"}) {
    CAPTURE(key);
    CHECK(json.contains(key));
  }
  CHECK(json["scene"] == "bar");
  CHECK(json["status"] == "equilibrium");
  CHECK(json["phases"] == 1);
  CHECK(json["points"] == 12);
  CHECK(json["dofs"] == 9);
  for (const char* key : {"u_rel_l2", "u_rel_max", "stress_rel_l2"}) CHECK(json["error"][key] < 1e-8);
  CHECK(json["probes"]["p12"]["u"].get<double>() == Approx(0.001 * 115 / 12).epsilon(1e-8));
  const auto history = lines(out / "history.csv");
  CHECK(history.front() == "t,steps,rhs_evaluations,residual,kinetic_energy,p6.u,p6.stress,p12.u,p12.stress,distance");
  CHECK(history.size() > 100);
}

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

TEST_CASE("a figure that was not computed is null") {
  const auto json = test::parsed(
      to_json(run(bar({"stop.time=1", "stop.residual=0", "damping.strategy=none", "exact.u=0*x", "exact.stress=0"}))));
  CHECK(json["omega_1"].is_null());
  CHECK(json["c"].is_null());
  CHECK(json["error"].is_null());
}

TEST_CASE("the reaction of a support in space is in the summary with all of its components") {
  const auto json = test::parsed(to_json(run(scenes::load("oedometer", {"support[0].name=base"}))));
  const auto& base = json["reactions"]["base"];
  REQUIRE(base.size() == 3);
  CHECK(base["y"].get<double>() == Approx(2000 * 9.81).epsilon(1e-6));
  CHECK(std::abs(base["x"].get<double>()) < 1);
  CHECK(std::abs(base["z"].get<double>()) < 1);
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
  const Summary s = run(bar(crushed()));
  CHECK(s.status == RunStatus::diverged);
  CHECK(s.exit_status == 4);
}

TEST_CASE("history.csv is the same to the bit for 1 and 2 threads") {
  const TemporaryFolder folder;
  const Scene scene = bar({"grid.cells=8000", "body.points_per_cell=4", "stop.residual=0", "stop.time=0.01",
                           "output.every=0.002", "material.bar.law=neo-hookean"});
  run(scene, {.out = folder.path() / "1", .threads = 1});
  run(scene, {.out = folder.path() / "2", .threads = 2});
  CHECK(contents(folder.path() / "1" / "history.csv") == contents(folder.path() / "2" / "history.csv"));
  CHECK(lines(folder.path() / "1" / "history.csv").size() == 7);
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

TEST_CASE("a folder that cannot be written is bad input, found before anything runs") {
  CHECK_THROWS_WITH(run(bar(), {.out = "/proc/nowhere"}), Catch::Contains("--out /proc/nowhere: cannot be written"));
}

TEST_CASE("a folder in the place of an output file is bad input, found before anything runs") {
  for (const char* name :
       {"history.csv", "summary.json", "report.html", "history.csv.partial", "checkpoint.h5", "fields.h5"}) {
    const TemporaryFolder folder;
    run(bar({"stop.steps=10"}), {.out = folder.path() / "earlier"});
    const auto out = folder.path() / "out";
    std::filesystem::copy(folder.path() / "earlier", out);
    std::filesystem::remove(out / name);
    std::filesystem::create_directories(out / name / "in the way");
    CAPTURE(name);
    CHECK_THROWS_WITH(run(bar(), {.out = out}), Catch::Contains("cannot be written: Is a directory"));
    for (const char* kept : {"history.csv", "summary.json"}) CHECK(std::filesystem::exists(out / kept));
  }
}

TEST_CASE("nothing of an earlier run stands beside what a run that breaks down has left") {
  const TemporaryFolder folder;
  run(bar({"output.stages=[0.1]", "stop.steps=100"}), {.out = folder.path()});
  folder.write("unstable_mode.csv", "point,x,mode\n");
  const auto names = {"summary.json", "report.html", "fields.h5", "fields.xdmf", "history.csv", "unstable_mode.csv"};
  for (const char* name : names) CHECK(std::filesystem::exists(folder.path() / name));
  const auto breaks_down = [&] {
    if (is_stepping(folder.path())) throw std::runtime_error("the disk is full");
    return false;
  };
  CHECK_THROWS_WITH(run(bar(), {.out = folder.path(), .interrupted = breaks_down}), "the disk is full");
  for (const char* name : names) CHECK_FALSE(std::filesystem::exists(folder.path() / name));
  CHECK(lines(folder.path() / "history.csv.partial").size() > 1);
}

TEST_CASE("a row that rounding puts next to the end is the row at the end") {
  const TemporaryFolder folder;
  for (const char* method : {"erk:sofroniou-spaletta-5-3-4", "leapfrog"}) {  // 7 times 0.7 is not 4.9
    std::vector<std::string> overrides{"stop.residual=0", "stop.time=4.9", "output.every=0.7",
                                       std::string("integrator.method=") + method};
    if (std::string(method) != "leapfrog") overrides.push_back("integrator.rtol=1e-6");
    const Summary s = run(bar(overrides), {.out = folder.path()});
    CAPTURE(method, s.reason);
    CHECK(s.status == RunStatus::end_time);
    CHECK(s.t == 4.9);
    CHECK(s.dt > 1e-3);
    CHECK(lines(folder.path() / "history.csv").size() == 1 + 8);
  }
}

TEST_CASE("a failed run reports its last good state, the same in summary and history") {
  const TemporaryFolder folder;
  const Summary s = run(bar(crushed()), {.out = folder.path()});
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
  const Summary s = run(bar(crushed()));
  REQUIRE(s.status == RunStatus::diverged);
  CHECK(std::isfinite(s.residual));
}

TEST_CASE("a run that stops by its distance writes it down in the history and in the summary") {
  const TemporaryFolder folder;
  const Summary s = run(scenes::load("chain", {"stop.residual=0", "stop.distance=1e-4"}), {.out = folder.path()});
  REQUIRE(s.status == RunStatus::equilibrium);
  const auto json = json_of(folder.path() / "summary.json");
  CHECK(json["distance"].get<double>() == *s.distance);
  CHECK(*s.distance <= 1e-4);
  const auto history = lines(folder.path() / "history.csv");
  const auto last_cell = [](const std::string& line) { return line.substr(line.rfind(',') + 1); };
  CHECK(last_cell(history.front()) == "distance");
  CHECK(std::stod(last_cell(history[2])) > 1e-2);
  CHECK(std::stod(last_cell(history.back())) == *s.distance);
}

TEST_CASE("a distance that was not computed is null, and no column") {
  const TemporaryFolder folder;
  const Summary s = run(
      bar({"support=[]", "force=[]", "initial.v=1", "stop.residual=0", "stop.time=1", "exact.u=t", "exact.stress=0"}),
      {.out = folder.path()});
  CHECK_FALSE(s.distance);
  CHECK(json_of(folder.path() / "summary.json")["distance"].is_null());
  CHECK_THAT(lines(folder.path() / "history.csv").front(), !Catch::Contains("distance"));
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
