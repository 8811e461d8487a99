// How comparisons end: a way to rest that fails is a row, files are whole, and counts are the same on any machine.
#include <stillpoint/compare.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "linalg/multigrid.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;
using stillpoint::test::contents;
using stillpoint::test::json_of;
using stillpoint::test::TemporaryFolder;

namespace {

Comparison compared(const std::string& problem, CompareOptions options, const std::vector<std::string>& set = {}) {
  if (options.integrators.empty()) options.integrators = {"leapfrog"};
  if (options.threads == 0) options.threads = 1;  // tests run side by side
  return compare(load_scene(std::string(STILLPOINT_PROBLEMS) + "/" + problem + ".toml", set), options);
}

const ComparedRun& row(const Comparison& c, const std::string& label) {
  const auto found = std::ranges::find(c.runs, label, &ComparedRun::label);
  if (found == c.runs.end()) throw std::out_of_range("no row " + label);
  return *found;
}

const std::vector<std::string> crushed = {"material.bar.law=neo-hookean", "force=[{at=10.0, value=-1000.0}]"};
const std::vector<std::string> to_time_20 = {"stop.residual=0", "stop.time=20"};

}  // namespace

TEST_CASE("strategies that walls refuse are rows with the reason, beside those that arrive", "[compare]") {
  const Comparison c = compared("block_on_wall", {.strategies = {"viscous", "cg", "newton"}, .repeats = 0},
                                {"stop.residual=1e-6", "stop.time=0"});
  CHECK(row(c, "viscous 0.9").status == ComparedStatus::converged);
  CHECK(c.by_residual);  // with friction there are many equilibria
  for (const char* refused : {"cg", "newton"}) {
    const ComparedRun& run = row(c, refused);
    CHECK(run.status == ComparedStatus::refused);
    CHECK_FALSE(run.reason.empty());
    CHECK(run.evaluations == 0);
    CHECK(std::isnan(run.error));
  }
  CHECK_THAT(row(c, "cg").reason, Contains("no wall can open or close"));
  CHECK_THAT(row(c, "newton").reason, Contains("no wall can open or close"));
}

TEST_CASE("a strategy named with :multigrid is a row of its own, with the set-up of its hierarchy", "[compare]") {
  if (!multigrid_is_missing().empty()) return;
  const std::vector<std::string> strategies = {"auto",         "auto:multigrid",      "viscous:multigrid",
                                               "cg:multigrid", "newton-cg:multigrid", "fire:multigrid"};
  const Comparison c = compared("incompressible", {.strategies = strategies, .repeats = 1}, {"constants.nu=0.3"});
  REQUIRE(c.runs.size() == strategies.size());
  for (const char* label : {"auto:multigrid", "viscous:multigrid 0.9", "cg:multigrid", "newton-cg:multigrid"}) {
    const ComparedRun& run = row(c, label);
    CAPTURE(label, run.reason);
    CHECK(run.status == ComparedStatus::converged);
    CHECK(run.mass == "multigrid");
    CHECK(run.evaluations <= 60);
    CHECK(run.error <= 1e-6);
    CHECK(std::ranges::any_of(run.setup_parts, [](const auto& part) { return part.first.starts_with("multigrid"); }));
  }
  CHECK(row(c, "fire:multigrid 0.9").status == ComparedStatus::refused);
  CHECK(row(c, "auto").mass.empty());
}

TEST_CASE("static solvers are compared also where a damping is set for the strategies that take it", "[compare]") {
  const Comparison c = compared("chain", {.strategies = {"cundall", "newton", "cg"}, .repeats = 0},
                                {"damping.strategy=cundall", "damping.alpha=0.2"});
  for (const char* label : {"cundall 0.9", "newton", "cg"}) CHECK(row(c, label).status == ComparedStatus::converged);
}

TEST_CASE("without names a comparison has the rows of multigrid that its scene goes with, and no others", "[compare]") {
  if (!multigrid_is_missing().empty()) return;
  const auto with_multigrid = [](const Comparison& c) {
    return std::ranges::count(c.runs, std::string("multigrid"), &ComparedRun::mass);
  };
  const CompareOptions options{.limit = 1, .repeats = 0};
  CHECK(with_multigrid(compared("chain", options)) == 9);
  CHECK(with_multigrid(compared("block_on_wall", options, {"stop.residual=1e-6", "stop.time=0"})) == 0);
  // Points that remember: the static solvers alone.
  CHECK(with_multigrid(compared("footing", options)) == 3);
}

TEST_CASE("a bar that is crushed on the way is a diverged row, and Newton's method still arrives", "[compare]") {
  const Comparison c = compared("bar", {.strategies = {"viscous", "newton"}, .repeats = 0}, crushed);
  CHECK(row(c, "viscous 0.9").status == ComparedStatus::diverged);
  CHECK_THAT(row(c, "viscous 0.9").reason, Contains("cannot be evaluated"));
  CHECK(row(c, "newton").status == ComparedStatus::converged);
}

TEST_CASE("a run at the limit is unfinished where it still came nearer, stalled where it did not", "[compare]") {
  const std::vector<std::string> integrators = {"leapfrog", "erk:bogacki-shampine-4-2-3:adaptive"};
  const Comparison c =
      compared("column", {.integrators = integrators, .strategies = {"none", "viscous"}, .limit = 1, .repeats = 0});
  CHECK(row(c, "viscous 0.9").status == ComparedStatus::converged);
  const char* undamped = "none, erk:bogacki-shampine-4-2-3 rtol 0.001";
  CHECK(row(c, undamped).status == ComparedStatus::stalled);
  CHECK_THAT(row(c, undamped).reason, Contains("after 1002 evaluations"));
  const Comparison slow = compared("incompressible", {.strategies = {"viscous"}, .limit = 0.5, .repeats = 0});
  CHECK(row(slow, "viscous 0.9").status == ComparedStatus::unfinished);
  CHECK_FALSE(row(slow, "viscous 0.9").wall_s);
}

TEST_CASE("a comparison that is interrupted has every row, and says which were not run", "[compare]") {
  const Comparison c =
      compared("chain", {.strategies = {"viscous", "newton"}, .repeats = 1, .interrupted = [] { return true; }});
  REQUIRE(c.runs.size() == 2);
  for (const ComparedRun& run : c.runs) CHECK(run.status == ComparedStatus::interrupted);
}

TEST_CASE("evaluations, steps and errors are the same for 1 and 2 threads", "[compare]") {
  const CompareOptions options = {.integrators = {"leapfrog", "erk:rk4", "erk:bogacki-shampine-4-2-3:adaptive"},
                                  .strategies = {"viscous", "kinetic", "auto", "newton"},
                                  .repeats = 0};
  CompareOptions one = options, two = options;
  one.threads = 1, two.threads = 2;
  const Comparison a = compared("column", one), b = compared("column", two);
  REQUIRE(a.runs.size() == b.runs.size());
  CHECK(a.runs.size() == 8);
  CHECK(b.threads == 2);
  for (std::size_t k = 0; k < a.runs.size(); ++k) {
    CAPTURE(a.runs[k].label());
    CHECK(a.runs[k].label() == b.runs[k].label());
    CHECK(a.runs[k].evaluations == b.runs[k].evaluations);
    CHECK(a.runs[k].steps == b.runs[k].steps);
    CHECK(a.runs[k].error == b.runs[k].error);
  }
}

TEST_CASE("a comparison's files are whole: a line and an object a run, and null where there is no figure",
          "[compare]") {
  const TemporaryFolder folder;
  const auto out = folder.path() / "new" / "out";
  const Comparison c = compared("bar", {.strategies = {"viscous", "newton"}, .repeats = 2}, crushed);
  write_comparison(c, out);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    ++files;
    CHECK(entry.path().extension() != ".partial");
  }
  CHECK(files == 3);

  std::istringstream csv(contents(out / "compare.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  REQUIRE(lines.size() == 1 + c.runs.size());
  const auto commas = [](const std::string& line) { return std::ranges::count(line, ','); };
  CHECK(lines[0].starts_with("strategy,integrator,step_fraction,rtol,status,steps,evaluations,"));
  CHECK(commas(lines[2]) == commas(lines[0]));
  CHECK(lines[1].starts_with("viscous,leapfrog,0.9"));

  const auto json = json_of(out / "compare.json");
  CHECK(json["scene"] == "bar");
  CHECK(json["goal_of"] == "error");
  CHECK(json["kappa"].get<double>() == *c.kappa);
  REQUIRE(json["runs"].size() == 2);
  const auto& newton = json["runs"][1];
  CHECK(newton["label"] == "newton");
  CHECK(newton["status"] == "converged");
  CHECK(newton["evaluations"] == row(c, "newton").evaluations);
  CHECK(newton["wall_s"]["least"] <= newton["wall_s"]["median"]);
  CHECK(newton["wall_s"]["median"] <= newton["wall_s"]["most"]);
  CHECK(newton["step_fraction"].is_null());
  CHECK(newton["total_s"].get<double>() >= newton["wall_s"]["median"].get<double>());
  const auto& viscous = json["runs"][0];
  CHECK(viscous["status"] == "diverged");
  CHECK(viscous["wall_s"].is_null());
  CHECK(viscous["total_s"].is_null());
  CHECK(viscous["samples"].size() == row(c, "viscous 0.9").samples.size());
  CHECK(viscous["samples"][0].size() == json["sample"].size());
}

TEST_CASE("a row has the time that its own set-up would take, whoever made its parts, by part and in total",
          "[compare]") {
  const TemporaryFolder folder;
  const Comparison c = compared("column", {.strategies = {"viscous", "kinetic", "newton"}, .repeats = 1});
  for (const ComparedRun& run : c.runs) {
    CAPTURE(run.label());
    double parts = 0;
    for (const auto& [part, seconds] : run.setup_parts) {
      CHECK(seconds > 0);
      parts += seconds;
    }
    CHECK(parts > 0);
    CHECK(run.setup_s >= parts);
    CHECK(run.total_s().value() == run.setup_s + run.wall_s->median);
  }
  const auto omega_1 = [&](const char* label) {
    for (const auto& [part, seconds] : row(c, label).setup_parts)
      if (part == "omega_1") return seconds;
    throw std::out_of_range("no omega_1");
  };
  CHECK(omega_1("viscous 0.9") == omega_1("kinetic 0.9"));  // made once
  CHECK(c.timed_s > 0);
  CHECK(c.wall_s > c.timed_s);
  write_comparison(c, folder.path());
  const auto json = json_of(folder.path() / "compare.json");
  CHECK(json["runs"][0]["setup_parts_s"]["omega_1"].get<double>() == omega_1("viscous 0.9"));
  std::istringstream csv(contents(folder.path() / "compare.csv"));
  std::string heading;
  std::getline(csv, heading);
  CHECK(heading.ends_with(",total_s,mass"));
}

TEST_CASE("a row that was refused has no error in the files, not one of 0", "[compare]") {
  const TemporaryFolder folder;
  const Comparison c =
      compared("block_on_wall", {.strategies = {"cg"}, .repeats = 0}, {"stop.residual=1e-6", "stop.time=0"});
  write_comparison(c, folder.path());
  const auto json = json_of(folder.path() / "compare.json");
  CHECK(json["runs"][0]["error"].is_null());
  CHECK(json["runs"][0]["residual"].is_null());
  CHECK_THAT(contents(folder.path() / "compare.csv"), !Contains("nan"));
}

// --- transients -----------------------------------------------------------------------------------

TEST_CASE("in a transient the error falls with the step at the order of the method", "[compare]") {
  const Comparison c =
      compared("bar",
               {.integrators = {"leapfrog", "symplectic-euler", "erk:bogacki-shampine-4-2-3", "erk:rk4"},
                .step_fractions = {0.4, 0.2, 0.1},
                .repeats = 0},
               to_time_20);
  CHECK(c.transient);
  CHECK_FALSE(c.chebyshev_estimate);
  REQUIRE(c.runs.size() == 12);
  const std::vector<double> orders = {2, 1, 3, 4};
  for (std::size_t k = 0; k < c.runs.size(); ++k) {
    CHECK(c.runs[k].status == ComparedStatus::converged);
    if (k % 3 == 0) continue;
    const ComparedRun &coarse = c.runs[k - 1], &fine = c.runs[k];
    const double order = std::log(coarse.error / fine.error) /
                         std::log(static_cast<double>(fine.steps) / static_cast<double>(coarse.steps));
    CAPTURE(fine.label(), coarse.error, fine.error);
    CHECK(order == Approx(orders[k / 3]).margin(0.15));
  }
}

TEST_CASE("in a transient a tighter tolerance costs more and errs less", "[compare]") {
  const Comparison c = compared(
      "bar", {.integrators = {"erk:bogacki-shampine-4-2-3:adaptive"}, .tolerances = {1e-4, 1e-6, 1e-8}, .repeats = 0},
      {"stop.residual=0", "stop.time=20", "damping.strategy=none"});
  REQUIRE(c.runs.size() == 3);
  for (std::size_t k = 1; k < 3; ++k) {
    CHECK(c.runs[k].error < 0.2 * c.runs[k - 1].error);
    CHECK(c.runs[k].evaluations > c.runs[k - 1].evaluations);
  }
}

// --- overshoot ------------------------------------------------------------------------------------

namespace {

/// A column of soil that yields under its own weight, which grows for so many seconds; its lowest period is 0.38 s.
Comparison yielding_column(const std::string& seconds) {
  return compared("column", {.strategies = {"viscous", "one-sided", "newton"}, .repeats = 0, .overshoot = true},
                  {"material.soil={law='drucker-prager', E=2e7, nu=0.2, rho=2000, phi=20, c=1000}", "grid.cells=[1, 8]",
                   "phase.max_motion=none", "body_force.value=[0, '-g*min(t/" + seconds + ", 1)']", "stop.time=10",
                   "stop.residual=1e-6"});
}

}  // namespace

TEST_CASE("one-sided damping overshoots where soil yields, less under a load that grows; viscous damping does not",
          "[compare]") {
  const Comparison step = yielding_column("1e-4"), ramp = yielding_column("0.5"), slow = yielding_column("2");
  const auto overshoot = [](const Comparison& c, const std::string& label) {
    CHECK(row(c, label).status == ComparedStatus::converged);
    return row(c, label).overshoot.value();
  };
  CHECK(overshoot(step, "one-sided 0.9") > 0.1);
  CHECK(overshoot(ramp, "one-sided 0.9") < 0.6 * overshoot(step, "one-sided 0.9"));
  CHECK(overshoot(slow, "one-sided 0.9") < 0.1 * overshoot(step, "one-sided 0.9"));
  for (const Comparison* c : {&step, &ramp, &slow}) {
    CHECK(c->by_residual);
    CHECK(overshoot(*c, "viscous 0.9") < 1e-6);
    CHECK(overshoot(*c, "newton") == Approx(c->ramp_difference.value()).epsilon(1e-3));
  }
}

TEST_CASE("of an elastic body the overshoot is no more than the error, and of Newton's method rounding", "[compare]") {
  const Comparison c =
      compared("chain", {.strategies = {"viscous", "kinetic", "one-sided", "newton"}, .repeats = 0, .overshoot = true});
  CHECK(c.ramp_difference.value() < 1e-11);
  CHECK(row(c, "newton").overshoot.value() < 1e-11);
  for (const char* label : {"viscous 0.9", "kinetic 0.9", "one-sided 0.9"}) {
    CHECK(row(c, label).overshoot.value() == Approx(row(c, label).error).epsilon(1e-3));
  }
}

TEST_CASE("a transient whose error is as large as its displacement has not converged", "[compare]") {
  // Past the critical step for a while: it has grown, but is finite at stop.time.
  const Comparison c = compared("bar", {.strategies = {"viscous"}, .step_fractions = {0.9, 1.03}, .repeats = 0},
                                {"stop.residual=0", "stop.time=20", "integrator.unstable_reason=to see it grow"});
  const ComparedRun &stable = row(c, "viscous 0.9"), &grown = row(c, "viscous 1.03");
  CHECK(stable.status == ComparedStatus::converged);
  CHECK(stable.error < 1);
  CHECK(grown.error > 1e2);
  CHECK(grown.status == ComparedStatus::inaccurate);
  CHECK_THAT(grown.reason, Contains("as large as the displacement"));
}
