// Comparisons of a motion in time, and of the way by which a body that yields comes to rest.
#include <stillpoint/compare.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "comparisons.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

namespace {

/// A column of soil that yields under its own weight, which grows for so many seconds; its lowest period is 0.38 s.
Comparison yielding_column(const std::string& seconds) {
  return compared("column", {.strategies = {"viscous", "one-sided", "newton"}, .repeats = 0, .overshoot = true},
                  {"material.soil={law='drucker-prager', E=2e7, nu=0.2, rho=2000, phi=20, c=1000}", "grid.cells=[1, 8]",
                   "phase.max_motion=none", "body_force.value=[0, '-g*min(t/" + seconds + ", 1)']", "stop.time=10",
                   "stop.residual=1e-6"});
}

}  // namespace

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

TEST_CASE("one-sided damping overshoots where soil yields, less under a load that grows, and viscous does not",
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
