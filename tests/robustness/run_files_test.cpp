// What a run leaves in its folder: whole, the same on any machine, and nothing of an earlier run.
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "partial_files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using scenes::bar;

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

TEST_CASE("history.csv is the same to the bit for 1 and 2 threads") {
  const TemporaryFolder folder;
  const Scene scene = bar({"grid.cells=8000", "body.points_per_cell=4", "stop.residual=0", "stop.time=0.01",
                           "output.every=0.002", "material.bar.law=neo-hookean"});
  run(scene, {.out = folder.path() / "1", .threads = 1});
  run(scene, {.out = folder.path() / "2", .threads = 2});
  CHECK(contents(folder.path() / "1" / "history.csv") == contents(folder.path() / "2" / "history.csv"));
  CHECK(lines(folder.path() / "1" / "history.csv").size() == 7);
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
