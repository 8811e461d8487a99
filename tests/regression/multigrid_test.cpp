// A mass whose inverse is a cycle of multigrid: steps that do not grow with the body, the same equilibrium, and an
// error bound in the norm of the strain energy.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "largest.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "multigrid_runs.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

namespace {

/// u of K u = F, by another factorisation.
std::vector<double> equilibrium(const LagrangianPhase& phase) {
  std::vector<double> u(phase.size());
  phase.external_force(0, u, u);
  SparseCholesky(phase.tangents().matrix(Tangent::elastic, 0, std::vector<double>(phase.size()))).solve(u, u);
  return u;
}

/// ‖u − u*‖_K/‖u‖_K
double true_distance(const Simulation& simulation) {
  const LagrangianPhase& phase = simulation.parts().phase;
  const ConstVec u = simulation.u();
  std::vector<double> e = equilibrium(phase), Ke(e.size()), Ku(e.size());
  for (std::size_t i = 0; i < e.size(); ++i) e[i] -= u[i];
  const std::vector<double> zero(e.size());
  phase.tangents().apply(Tangent::elastic, 0, zero, e, Ke);
  phase.tangents().apply(Tangent::elastic, 0, zero, u, Ku);
  double of_error = 0, of_u = 0;
  for (std::size_t i = 0; i < e.size(); ++i) of_error += e[i] * Ke[i], of_u += u[i] * Ku[i];
  return std::sqrt(of_error / of_u);
}

}  // namespace

TEST_CASE(
    "with a multigrid mass 1e3, 1e4 and 1e5 unknowns come to rest in 25 evaluations by critical viscous damping, "
    "16 by auto, in balance as by a factor") {
  REQUIRE_MULTIGRID();
  const auto [strategy, most] = GENERATE(table<std::string, long>({{"viscous", 25}, {"auto", 16}}));
  for (const int cells : {22, 70, 224}) {
    CAPTURE(strategy, cells);
    Simulation simulation = run("incompressible", block(cells, {"damping.strategy=" + strategy}));
    CHECK(simulation.evaluations() <= most);
    CHECK(simulation.residual() <= 1e-6);
    const std::vector<double> u = equilibrium(simulation.parts().phase);
    CHECK(largest_difference(simulation.u(), u) < 1e-5 * largest_magnitude(u));
  }
}

TEST_CASE("the distance of a run by a multigrid mass bounds that of the strain energy, not by more than ten times") {
  REQUIRE_MULTIGRID();
  const std::string strategy = GENERATE("viscous", "auto");
  const auto* residual = GENERATE("stop.residual=1e-4", "stop.residual=1e-7");
  CAPTURE(strategy, residual);
  Simulation simulation = run("incompressible", block(48, {"damping.strategy=" + strategy, residual}));
  const double error = true_distance(simulation);
  REQUIRE(simulation.distance());
  CHECK(*simulation.distance() >= error);
  CHECK(*simulation.distance() < 10 * error);
}

TEST_CASE(
    "cg, lbfgs and newton-cg with a multigrid mass come to the equilibrium of a factor in a few dozen evaluations") {
  REQUIRE_MULTIGRID();
  const std::string method = GENERATE("cg", "lbfgs", "newton-cg");
  CAPTURE(method);
  Scene scene = scenes::load("incompressible", block(70));
  scene.solve.method = method;
  Simulation simulation(scene);
  simulation.run();
  CHECK(simulation.status() == RunStatus::equilibrium);
  CHECK(simulation.evaluations() <= 40);
  const std::vector<double> u = equilibrium(simulation.parts().phase);
  CHECK(largest_difference(simulation.u(), u) < 1e-5 * largest_magnitude(u));
}

TEST_CASE(
    "a neo-Hookean block pressed to 70 % comes by newton-cg and auto with a multigrid mass where Newton's method does, "
    "in 60 evaluations") {
  REQUIRE_MULTIGRID();
  // No load: what is out of balance is the state to begin with, pressed without bulging.
  const std::string text = R"(
dim = 2
[grid]
min = [-0.5, 0.0]
max = [1.5, 1.0]
cells = [48, 24]
basis = "linear"
[body]
min = [0.0, 0.0]
max = [1.0, 1.0]
material = "rubber"
state = "plane-strain"
points_per_cell = 4
volumes = "consistent"
[material.rubber]
law = "neo-hookean"
E = 1.0
nu = 0.3
rho = 1.0
[[support]]
face = "bottom"
[[support]]
face = "top"
kind = "roller"
u = -0.3
[initial]
u = ["0.0", "-0.3*y"]
[phase]
max_motion = "none"
[stop]
residual = 1e-8
)";
  const auto pressed = [&](const std::vector<std::string>& set) {
    Simulation simulation(load_scene("pressed.toml", text, set));
    simulation.run();
    CHECK(simulation.status() == RunStatus::equilibrium);
    return simulation;
  };
  const auto check = [&](const Simulation& by_multigrid, const Simulation& by_factor) {
    CHECK(largest_difference(by_multigrid.u(), by_factor.u()) < 1e-6 * largest_magnitude(by_factor.u()));
    CHECK(by_multigrid.evaluations() <= 60);
  };
  const Simulation coarse = pressed({"solve.method=newton"});
  check(pressed({"solve.method=newton-cg", "mass.kind=multigrid"}), coarse);
  check(pressed({"damping.strategy=auto", "mass.kind=multigrid"}), coarse);
  check(pressed({"damping.strategy=auto", "mass.kind=multigrid", "grid.cells=[192,96]", "stop.residual=1e-7"}),
        pressed({"solve.method=newton", "grid.cells=[192,96]"}));
}

TEST_CASE(
    "an inclusion a million times as stiff takes critical damping and auto with a multigrid mass 40 evaluations at "
    "most") {
  REQUIRE_MULTIGRID();
  const auto* strategy = GENERATE("damping.strategy=auto", "damping.strategy=viscous");
  for (const auto* cells : {"grid.cells=[24,24]", "grid.cells=[96,96]", "grid.cells=[192,192]"}) {
    CAPTURE(strategy, cells);
    CHECK(run("inclusion", {cells, strategy, "mass.kind=multigrid"}).evaluations() <= 40);
  }
}

TEST_CASE("quadratic and cubic functions come to rest by a multigrid mass as linear ones do") {
  REQUIRE_MULTIGRID();
  const std::string basis = GENERATE("quadratic", "cubic");
  CAPTURE(basis);
  Simulation simulation = run("incompressible", block(48, {"grid.basis=" + basis, "damping.strategy=auto"}));
  CHECK(simulation.evaluations() <= 40);
  const std::vector<double> u = equilibrium(simulation.parts().phase);
  CHECK(largest_difference(simulation.u(), u) < 1e-4 * largest_magnitude(u));
}

TEST_CASE("what finds rest by a motion does so with a multigrid mass in a few dozen evaluations, in any body") {
  REQUIRE_MULTIGRID();
  const auto [strategy, method, most] = GENERATE(table<std::string, std::string, long>({
      {"kinetic", "leapfrog", 60},
      {"adaptive", "leapfrog", 40},
      {"papadrakakis", "leapfrog", 40},
      {"chebyshev", "leapfrog", 20},
      {"viscous", "symplectic-euler", 30},
      {"viscous", "erk:heun-euler-2-1-2", 90},
      {"viscous", "gsl:rk4", 300},
      {"kinetic", "erk:rk4", 400},
  }));
  for (const int cells : {22, 70}) {
    CAPTURE(strategy, method, cells);
    const Simulation simulation =
        run("incompressible", block(cells, {"damping.strategy=" + strategy, "integrator.method=" + method}));
    CHECK(simulation.evaluations() <= most);
    const std::vector<double> u = equilibrium(simulation.parts().phase);
    CHECK(largest_difference(simulation.u(), u) < 1e-5 * largest_magnitude(u));
  }
}

// Which way a slender body takes to its equilibrium is a matter of rounding: 560 to 1050 evaluations, where a lumped
// mass takes 5070.
TEST_CASE("a cantilever that bends by half its length takes auto a sixth of the evaluations with a multigrid mass") {
  REQUIRE_MULTIGRID();
  const auto bent = [](const char* mass, const char* load = "constants.load=2") {
    return run("cantilever", {"damping.strategy=auto", mass, load});
  };
  const Simulation lumped = bent("mass.kind=lumped");
  std::vector<long> evaluations;
  for (const char* load : {"constants.load=2", "constants.load=2.000001", "constants.load=1.999999",
                           "constants.load=2.00001", "constants.load=1.99999"}) {
    const Simulation multigrid = bent("mass.kind=multigrid", load);
    evaluations.push_back(multigrid.evaluations());
    CHECK(multigrid.evaluations() < lumped.evaluations() / 4);
    CHECK(largest_difference(multigrid.u(), lumped.u()) < 2e-5 * largest_magnitude(lumped.u()));  // 1e-5 of it the load
  }
  std::ranges::sort(evaluations);
  CHECK(evaluations[2] < lumped.evaluations() / 6);
}

TEST_CASE(
    "a footing on ground that flows without dilating comes by newton-cg with a multigrid mass where UMFPACK leads") {
  REQUIRE_MULTIGRID();
  const std::vector<std::string> not_associated = {"material.ground.psi=0", "stop.residual=1e-8"};
  const auto by = [&](const char* method, const char* mass) {
    std::vector<std::string> set = {std::string("solve.method=") + method, mass};
    set.insert(set.end(), not_associated.begin(), not_associated.end());
    return run("footing", set);
  };
  const Simulation factor = by("newton", "mass.kind=lumped"), multigrid = by("newton-cg", "mass.kind=multigrid");
  CHECK(largest_difference(multigrid.u(), factor.u()) < 1e-6 * largest_magnitude(factor.u()));
}

TEST_CASE("cells that the border cuts to a billionth of them take no more than 40 evaluations with a multigrid mass") {
  REQUIRE_MULTIGRID();
  const std::string basis = GENERATE("linear", "quadratic"), strategy = GENERATE("viscous", "auto");
  for (const double share : {1e-1, 1e-3, 1e-6, 1e-9}) {
    CAPTURE(basis, strategy, share);
    const std::string border = fmt::format("{:.17g}", (15 + share) / 20);
    const Simulation cut = run("incompressible", {"constants.nu=0.3", "grid.basis=" + basis, "grid.cells=[25,20]",
                                                  "body.max=[" + border + "," + border + "]", "mass.kind=multigrid",
                                                  "damping.strategy=" + strategy, "stop.residual=1e-6", "probe=[]"});
    CHECK(cut.evaluations() <= 40);
    const std::vector<double> u = equilibrium(cut.parts().phase);
    CHECK(largest_difference(cut.u(), u) < 1e-5 * largest_magnitude(u));
  }
}
