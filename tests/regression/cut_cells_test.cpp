// Bodies whose faces do not lie on grid lines: frequencies, steps and static answers as if they did.
#include <stillpoint/spectrum.hpp>

#include <numbers>

#include <fmt/format.h>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "statics.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Contains;
using scenes::with;
using stillpoint::test::TemporaryFolder;

namespace {

const std::vector<std::string> bases = {"linear", "quadratic", "cubic", "hermite"};
const std::vector<std::string> slivers = {"0.3", "1e-1", "1e-2", "1e-3", "1e-5", "1e-6", "1e-9"};  // shares of a cell

// A bar of length 1 + sliver h, held at one end: u'' = 1 under its weight.
Scene cut_bar(const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  return load_scene(folder.write("bar.toml", R"(
dim = 1
[constants]
sliver = 0.0
L = "1 + 0.1*sliver"
[grid]
min = 0.0
max = 1.2
cells = 12
[body]
min = 0.0
max = "L"
material = "bar"
placement = "gauss"
points_per_cell = 4
[material.bar]
law = "linear-elastic"
E = 1.0
nu = 0.0
rho = 1.0
[[support]]
at = 0.0
[body_force]
value = -1.0
[damping]
strategy = "viscous"
c = "critical"
)"),
                    overrides);
}

// A block of (1 + sliver h)², held at the left and on rollers at the bottom, pulled to the right.
Scene cut_block(const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  return load_scene(folder.write("block.toml", R"(
dim = 2
[constants]
sliver = 0.0
L = "1 + 0.125*sliver"
[grid]
min = [0.0, 0.0]
max = [1.25, 1.25]
cells = [10, 10]
[body]
min = [0.0, 0.0]
max = ["L", "L"]
material = "block"
state = "plane-strain"
placement = "gauss"
points_per_cell = 16
[material.block]
law = "linear-elastic"
E = 1.0
nu = 0.25
rho = 1.0
[mass]
kind = "lumped"
[[support]]
face = "left"
kind = "roller"
[[support]]
face = "bottom"
kind = "roller"
[[traction]]
face = "right"
value = [1e-3, 0.0]
[damping]
strategy = "viscous"
c = "critical"
)"),
                    overrides);
}

// Cook's membrane under its weight, held at its left.
Scene cook(const std::vector<std::string>& overrides) {
  const TemporaryFolder folder;
  return load_scene(folder.write("cook.toml", R"(
dim = 2
[grid]
min = [0.0, 0.0]
max = [48.0, 60.0]
cells = [17, 21]
[body]
polygon = [[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]]
material = "membrane"
state = "plane-strain"
points_per_cell = 9
[material.membrane]
law = "linear-elastic"
E = 1.0
nu = 0.3333
rho = 1.0
[mass]
kind = "lumped"
[[support]]
face = "left"
[body_force]
value = [0.0, -1e-5]
[damping]
strategy = "viscous"
c = "critical"
[stop]
residual = 1e-6
)"),
                    overrides);
}

std::vector<double> at_rest(const LagrangianPhase& phase) { return std::vector<double>(phase.size(), 0.0); }

double omega_1(const LagrangianPhase& phase) {
  const FrequencyEstimate estimate = omega_1_by_arpack(phase, 0, at_rest(phase));
  INFO(estimate.status);
  CHECK(estimate.converged);
  return estimate.omega;
}
double omega_max(const LagrangianPhase& phase) { return omega_max_by_arpack(phase, 0, at_rest(phase)).omega; }

}  // namespace

TEST_CASE("a bar that ends in a sliver of a cell has the omega_1 of a bar, pi/(2 L), with any basis and mass") {
  for (const std::string mass : {"lumped", "consistent"}) {
    for (const std::string& basis : bases) {
      for (const std::string& sliver : slivers) {
        const auto phase =
            make_phase(cut_bar({"grid.basis=" + basis, "mass.kind=" + mass, "constants.sliver=" + sliver}));
        CAPTURE(mass, basis, sliver);
        const double L = 1 + 0.1 * std::stod(sliver);
        CHECK(omega_1(*phase) == Approx(std::numbers::pi / (2 * L)).epsilon(0.005));
      }
    }
  }
}

TEST_CASE("a sliver does not shorten the critical step") {
  for (const std::string mass : {"lumped", "consistent"}) {
    for (const std::string& basis : bases) {
      const std::vector<std::string> scene = {"grid.basis=" + basis, "mass.kind=" + mass};
      const double uncut = omega_max(*make_phase(cut_bar(scene)));
      for (const std::string sliver : {"0.1", "1e-2", "1e-4", "1e-6"}) {
        CAPTURE(mass, basis, sliver);
        CHECK(omega_max(*make_phase(cut_bar(with(scene, {"constants.sliver=" + sliver})))) < 1.3 * uncut);
      }
    }
  }
}

TEST_CASE("a bar that ends in a sliver settles by g L²/2 exactly where the basis has degree 2 or more") {
  for (const std::string basis : {"quadratic", "cubic", "hermite"}) {
    for (const std::string& sliver : slivers) {
      CAPTURE(basis, sliver);
      const auto phase = make_phase(cut_bar({"grid.basis=" + basis, "constants.sliver=" + sliver}));
      const std::vector<double> u = statics::point_displacement(*phase, statics::solution(*phase));
      const std::vector<double> x = phase->fields().positions();
      const double L = 1 + 0.1 * std::stod(sliver);
      double worst = 0;
      for (std::size_t p = 0; p < x.size(); ++p)
        worst = !(std::abs(u[p] + x[p] * (L - x[p] / 2)) <= worst) ? std::abs(u[p] + x[p] * (L - x[p] / 2)) : worst;
      CHECK(worst < 1e-9);
    }
  }
}

TEST_CASE("a block with slivers along two faces is stretched evenly by a traction on one of them") {
  const double E = 1, nu = 0.25, stress = 1e-3;
  for (const std::string& basis : bases) {
    for (const std::string sliver : {"0.1", "1e-2", "1e-4", "1e-6"}) {
      CAPTURE(basis, sliver);
      const auto phase = make_phase(cut_block({"grid.basis=" + basis, "constants.sliver=" + sliver}));
      const std::vector<double> u = statics::solution(*phase), of_points = statics::point_displacement(*phase, u);
      const std::vector<double> x = phase->fields().positions();
      double worst = 0;
      for (std::size_t p = 0; p < phase->points(); ++p) {
        const double error = std::max(std::abs(of_points[2 * p] - stress * (1 - nu * nu) / E * x[2 * p]),
                                      std::abs(of_points[2 * p + 1] + stress * nu * (1 + nu) / E * x[2 * p + 1]));
        worst = !(error <= worst) ? error : worst;
      }
      CHECK(worst < 1e-6 * stress);
    }
  }
}

TEST_CASE("supports bear the weight and the tractions of a block with slivers") {
  const double stress = 1e-3, weight = 2e-3;
  for (const std::string& basis : bases) {
    for (const std::string sliver : {"0.1", "1e-3", "1e-5"}) {
      CAPTURE(basis, sliver);
      const Summary s = run(cut_block(
          {"grid.basis=" + basis, "constants.sliver=" + sliver, fmt::format("body_force.value=[0, {}]", -weight),
           "support=[{face='left', kind='roller', name='side'}, {face='bottom', kind='roller', name='base'}]",
           "solve.method=newton"}));
      REQUIRE(s.status == RunStatus::equilibrium);
      const double L = 1 + 0.125 * std::stod(sliver);
      CHECK(s.reactions.at("side")[0] == Approx(-stress * L).epsilon(1e-9));
      CHECK(s.reactions.at("base")[1] == Approx(weight * L * L).epsilon(1e-9));
    }
  }
}

TEST_CASE("a block that cuts cells has the omega_1 of one that does not") {
  for (const std::string basis : {"linear", "quadratic", "hermite"}) {
    const double uncut = omega_1(*make_phase(cut_block({"grid.basis=" + basis})));
    for (const std::string sliver : {"0.1", "1e-2", "1e-4", "1e-6", "1e-9"}) {
      CAPTURE(basis, sliver);
      const auto phase = make_phase(cut_block({"grid.basis=" + basis, "constants.sliver=" + sliver}));
      CHECK(omega_1(*phase) * (1 + 0.125 * std::stod(sliver)) == Approx(uncut).epsilon(0.02));
    }
  }
}

TEST_CASE("a lumped mass whose lowest mode hardly moves the material is told of, with what to change") {
  const auto told = [](const std::vector<std::string>& overrides) {
    const Model model = make_model(cut_block(overrides));
    return fmt::format("{}", fmt::join(model.notes, "\n")).find("functions which hardly reach the body") !=
           std::string::npos;
  };
  const double right = omega_1(*make_phase(cut_block({"mass.kind=consistent", "grid.cells=[40, 40]"})));
  REQUIRE(told({"grid.basis=cubic"}));  // a mode of the body's corner, which lies within the grid
  CHECK(omega_1(*make_phase(cut_block({"grid.basis=cubic"}))) < 0.6 * right);
  CHECK_FALSE(told({"grid.basis=cubic", "solve.method=newton"}));  // which needs no damping
  for (const std::vector<std::string>& change : std::vector<std::vector<std::string>>{
           {"grid.max=[1.0, 1.0]", "grid.cells=[8, 8]"}, {"grid.basis=quadratic"}, {"mass.kind=consistent"}}) {
    CAPTURE(change.front());
    const std::vector<std::string> changed = with({"grid.basis=cubic"}, change);
    CHECK_FALSE(told(changed));
    CHECK(omega_1(*make_phase(cut_block(changed))) == Approx(right).epsilon(0.02));
  }
}

TEST_CASE("Cook's membrane has its omega_1, or the scene is told that what was found is none") {
  const double fine = omega_1(*make_phase(cook({"grid.basis=quadratic", "grid.cells=[46, 57]"})));
  int told = 0;
  for (const std::string& basis : bases) {
    for (const std::string cells : {"[8, 10]", "[12, 15]", "[17, 21]", "[23, 28]"}) {
      const Model model = make_model(cook({"grid.basis=" + basis, "grid.cells=" + cells}));
      const std::string notes = fmt::format("{}", fmt::join(model.notes, "\n"));
      CAPTURE(basis, cells, notes, *model.omega_1, fine);
      const bool is_told = notes.find("functions which hardly reach the body") != std::string::npos;
      told += is_told ? 1 : 0;
      if (basis == "linear" || basis == "quadratic") CHECK_FALSE(is_told);
      if (!is_told) CHECK(*model.omega_1 == Approx(fine).epsilon(0.025));
    }
  }
  CHECK(told <= 6);
}

TEST_CASE("Cook's membrane with a cubic basis comes to rest as soon as with a quadratic one") {
  const long quadratic = run(cook({"grid.basis=quadratic"})).rhs_evaluations;
  CHECK(run(cook({"grid.basis=cubic"})).rhs_evaluations < 2 * quadratic);
}

TEST_CASE("what is held in a sliver stays held") {
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    CAPTURE(basis);
    const auto phase = make_phase(cut_bar({"grid.basis=" + basis, "body.min=0.099", "constants.sliver=1e-3"}));
    CHECK(omega_1(*phase) > 0);
    CHECK(phase->shape().discretisation().quadrature.slivers == 2);
    CHECK(phase->shape().discretisation().quadrature.joined == 1);
  }
}

TEST_CASE("a body whose faces lie on grid lines, or that moves on, keeps every function of its cells") {
  for (const auto& scene :
       {cut_bar({}), cut_block({}), scenes::load("footing"), scenes::load("inclusion"), scenes::load("slope"),
        cut_block(
            {"constants.sliver=0.01", "material.block={law='hencky', E=1, nu=0.25, rho=1}", "phase.max_motion=0.1"})}) {
    CAPTURE(scene.name);
    CHECK(make_phase(scene)->shape().discretisation().quadrature.joined == 0);
  }
}
