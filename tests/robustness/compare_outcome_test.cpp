// How comparisons end: a way to rest that fails is a row, and counts are the same on any machine.
#include <stillpoint/compare.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparisons.hpp"
#include "linalg/multigrid.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

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
