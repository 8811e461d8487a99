// What auto costs beside the other strategies, and beside the Chebyshev estimate ½ √κ ln(2/ε).
#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "solvers/relaxation/relaxing.hpp"
#include "temporary_folder.hpp"
#include "way_to_rest.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

/// What auto spends with no frequency given: force evaluations and applications of K.
long auto_spends(SemiDiscrete& system, const Values& solution) {
  const FrequencyEstimate found = omega_max_by_lanczos(system, 0, Values(system.size()));
  REQUIRE(found.converged);
  const Way way = {.strategy = "auto", .step_fraction = 0.95};
  return found.iterations + evaluations_to(1e-6, system, solution, found.omega, way);
}
/// The same in a scene, which compares physical mass and Gershgorin's as well.
long auto_spends(const Model& model, const Values& solution) {
  const Way way = {.strategy = "auto", .step_fraction = 1};
  return model.tangent_applications + evaluations_to(1e-6, *model.phase, solution, 2 / model.integrator.max_step, way);
}

double kappa_of(const SemiDiscrete& system) {
  const Values u(system.size());
  return std::pow(omega_max_by_arpack(system, 0, u).omega / omega_1_by_arpack(system, 0, u).omega, 2);
}

}  // namespace

TEST_CASE("auto costs no more than lbfgs where the stiffness changes", "[strategies]") {
  for (const double cubic : {1.0, 1e2, 1e4}) {
    ChainOptions options = long_chain();
    options.n = 40, options.cubic = cubic;
    const Chain chain(options);
    CAPTURE(cubic);
    CHECK(evaluations_of(chain, {.strategy = "auto"}) <= evaluations_of(chain, {.strategy = "lbfgs"}));
  }
}

TEST_CASE("auto needs at most 1.15 times the evaluations of the best matrix-free way, on elastic scenes of every kind",
          "[strategies]") {
  for (const std::string scene : {"chain", "bar", "column", "cylinder", "mms_bar", "block", "neo_hookean_bar",
                                  "incompressible", "ladder/column", "ladder/mms_square", "ladder/compaction"}) {
    const auto evaluations_of_run = [&](const std::string& strategy) {
      const Summary summary = run(scenes::load(scene, {"solve.method=relaxation", override_of(strategy)}));
      CAPTURE(scene, strategy, summary.reason);
      CHECK(summary.status == RunStatus::equilibrium);
      return static_cast<double>(summary.rhs_evaluations);
    };
    double best = evaluations_of_run("kinetic");
    if (scene != "ladder/compaction")  // in phases
      best = std::min({best, evaluations_of_run("cg"), evaluations_of_run("lbfgs")});
    CAPTURE(scene, best);
    CHECK(evaluations_of_run("auto") <= 1.15 * best);
  }
}

TEST_CASE(
    "on linear scenes leapfrog with c = 2 omega_1 at 0.95 of the critical step costs 1.3 Chebyshev estimates at most, "
    "and auto, which is told nothing, 1.6",
    "[strategies]") {
  const auto check = [](SemiDiscrete& system, double kappa, const Model* model = nullptr) {
    const Values solution = static_solution(system), rest(system.size());
    const double bound = lower_bound(kappa, 1e-6), omega_1 = omega_1_by_arpack(system, 0, rest).omega;
    const double omega_max = omega_max_by_arpack(system, 0, rest).omega;
    const long viscous = evaluations_to(1e-6, system, solution, omega_max,
                                        {.strategy = "viscous", .step_fraction = 0.95, .c = 2 * omega_1});
    const long itself = model ? auto_spends(*model, solution) : auto_spends(system, solution);
    INFO("kappa " << kappa << ", bound " << bound << ", c = 2 omega_1 " << viscous << ", auto " << itself);
    CHECK(static_cast<double>(viscous) <= 1.3 * bound);
    CHECK(static_cast<double>(itself) <= 1.6 * bound);
  };
  SECTION("a chain held at both ends under a uniform load") {
    Chain chain(long_chain());
    check(chain, kappa_of(chain));
  }
  SECTION("a chain of unequal masses with a free end that is pulled at two places") {
    std::mt19937 random(7);
    Values masses(70), loads(70);
    for (double& m : masses) m = 0.7 + 0.6 * static_cast<double>(random()) / 4294967296.0;
    loads[69] = 1, loads[20] = -3;
    LoadedChain chain({.masses = masses}, loads);
    const double kappa = kappa_of(chain);
    CHECK(kappa == Approx(1e4).epsilon(0.2));
    check(chain, kappa);
  }
  SECTION("a plane block that is bent and stretched") {
    const TemporaryFolder folder;
    const Scene scene = load_scene(folder.write("block.toml", R"(dim = 2
[grid]
min = [0, 0]
max = [2, 1]
cells = [20, 10]
[body]
material = "steel"
points_per_cell = 4
[material.steel]
law = "linear-elastic"
E = 1.0
nu = 0.3
rho = 1.0
[[support]]
face = "left"
[[traction]]
face = "right"
value = [1e-3, 5e-4]
[body_force]
value = [0, -1e-4]
[damping]
strategy = "auto"
[stop]
residual = 1e-6
)"));
    const Model model = make_model(scene);
    const double kappa = kappa_of(*model.phase);
    CHECK(kappa == Approx(1e4).epsilon(0.2));
    CHECK(model.tangent_applications == 24);
    check(*model.phase, kappa, &model);
  }
}
