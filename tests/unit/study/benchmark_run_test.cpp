// A run that is looked at now and then is measured as one whose every step is.
#include "study/benchmark_run.hpp"

#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/parts.hpp"

using namespace stillpoint;

namespace {

struct Arrival {
  long steps = 0, evaluations = 0, first = 0;
};

// The definition, step by step: from where on the error stays at the goal for a tenth of the way again.
Arrival arrival(const Scene& scene, const ReferenceSolution& exact, double goal) {
  Simulation simulation(scene, {.threads = 1, .records = false, .stops = false});
  const int estimating = simulation.parts().model.tangent_applications;
  Arrival found;
  while (true) {
    REQUIRE(simulation.step() == RunStatus::running);
    const long evaluations = simulation.evaluations() + estimating;
    if (exact.error(simulation.u()) > goal) {
      found.evaluations = 0;
    } else {
      if (found.evaluations == 0) found.steps = simulation.steps(), found.evaluations = evaluations;
      if (found.first == 0) found.first = evaluations;
    }
    if (found.evaluations > 0 && evaluations - found.evaluations >= std::max(50L, found.evaluations / 10)) return found;
    REQUIRE(evaluations < 100'000);
  }
}

}  // namespace

TEST_CASE("where the goal is met is known to the step, though most of the way is not looked at", "[compare]") {
  for (const std::string problem : {"column", "incompressible", "chain"}) {
    for (const std::string strategy : {"viscous", "kinetic", "papadrakakis", "auto", "cundall"}) {
      CAPTURE(problem, strategy);
      std::vector<std::string> set = {"damping.strategy=" + strategy, "phase.max_motion=none"};
      const Scene scene = scenes::load(problem, set);
      SetUpStore store;
      const Equilibrium exact = find_equilibrium(scene, 1, {}, store);
      const double goal = 1e-5;
      const Arrival expected = arrival(scene, exact.state, goal);
      ComparedRun run;
      const BenchmarkLimits limits{.goal = goal, .evaluations = 100'000, .seconds = 1e3};
      const double seconds = run_benchmark(scene, exact.state, limits, store, run);
      CHECK(run.status == ComparedStatus::converged);
      CHECK(run.steps == expected.steps);
      CHECK(run.evaluations == expected.evaluations);
      CHECK(run.first_evaluations == expected.first);
      CHECK(run.error <= goal);
      CHECK(seconds > 0);
    }
  }
}

TEST_CASE("samples of a way lie evenly by the logarithm of their evaluations, from the start to beyond the goal",
          "[compare]") {
  const Scene scene = scenes::load("incompressible");
  SetUpStore store;
  const Equilibrium exact = find_equilibrium(scene, 1, {}, store);
  ComparedRun run;
  run_benchmark(scene, exact.state, {.goal = 1e-6, .evaluations = 100'000, .seconds = 1e3}, store, run);
  REQUIRE(run.samples.size() > 100);
  CHECK(run.samples.front().evaluations <= 1);
  CHECK(run.samples.front().error == Approx(1));
  for (std::size_t k = 1; k < run.samples.size(); ++k) {
    const double before = static_cast<double>(run.samples[k - 1].evaluations);
    const double ahead = static_cast<double>(run.samples[k].evaluations) - before;
    CHECK(ahead >= 1);
    CHECK(ahead <= 2 + 0.02 * before);
    CHECK(run.samples[k].error <= run.samples[k].distance.value());  // the bound is one
  }
  CHECK(run.samples.back().evaluations >= run.evaluations);
}

TEST_CASE("errors are measured in the norm of the mass, whatever its kind", "[compare]") {
  for (const std::string kind : {"lumped", "consistent"}) {
    CAPTURE(kind);
    const Scene scene = scenes::load("column", {"phase.max_motion=none", "mass.kind=" + kind});
    SetUpStore store;
    const Equilibrium exact = find_equilibrium(scene, 1, {}, store);
    const std::vector<double>& u = exact.state.u();
    std::vector<double> at(u);
    for (double& value : at) value *= 1.25;
    CHECK(exact.state.error(u) == 0);
    CHECK(exact.state.error(at) == Approx(0.25).epsilon(1e-12));
    std::vector<double> Mu(u.size());
    store.phase(scene).phase->mass().apply(u, Mu);
    double sum = 0;
    for (std::size_t i = 0; i < u.size(); ++i) sum += u[i] * Mu[i];
    CHECK(exact.state.size() == Approx(std::sqrt(sum)).epsilon(1e-12));
  }
}
