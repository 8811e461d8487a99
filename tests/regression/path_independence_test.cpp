// An elastic body in phases remembers nothing of its way: however it was loaded, it comes to the one equilibrium.
#include <stillpoint/stillpoint.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

/// A column under its weight, E = ρ = 1, nu = 0, ρ g l/E = s0; max_motion 0.1.
Scene slow_column(double s0, int cells, const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"constants.s0=" + std::to_string(s0),
                                        "grid.cells=[" + std::to_string(cells) + "]"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const TemporaryFolder folder;
  return load_scene(folder.write("column.toml", R"(
dim = 1
[constants]
s0 = 1.0
rise = 0.001
[grid]
min = [0.0]
max = [1.0]
cells = [16]
basis = "quadratic"
[body]
material = "m"
points_per_cell = 4
volumes = "equal"
[material.m]
law = "hencky"
E = 1
nu = 0
rho = 1
[mass]
kind = "lumped"
[[support]]
at = 0.0
[body_force]
value = ['-s0*min(1, t/rise)']
[phase]
max_motion = 0.1
[damping]
strategy = "viscous"
c = "critical"
[stop]
residual = 1e-6
steps = 400000
time = 200
)"),
                    overrides);
}

/// w e^w = y
double lambert(double y) {
  double w = std::log1p(y);
  for (int k = 0; k < 50; ++k) w -= (w * std::exp(w) - y) / (std::exp(w) * (w + 1));
  return w;
}
/// σ = ln F/F = −s0 (1 − X), so that F = exp(−w) and u = ∫ (F − 1) dX with w e^w = s0 (1 − X).
double exact_u(double s0, double X) {
  const auto potential = [s0](double Y) {
    const double w = lambert(s0 * (1 - Y));
    return (w + w * w / 2) / s0;
  };
  return potential(0) - potential(X) - X;
}

struct Settled {
  Summary summary;
  double stress_error;  // Σ V |σ − exact|/(V ρ g l) [Coombs and Augarde 2020, eq. 46]
  double u_error;       // of the topmost point, as a share
};
Settled settled(double s0, int cells, const std::vector<std::string>& more = {}) {
  Simulation simulation(slow_column(s0, cells, more), {.records = false});
  while (!simulation.done()) simulation.run_until(simulation.t() + 1);
  const LagrangianPhase& phase = simulation.parts().phase;
  const std::vector<double> X = phase.fields().point_data().initial_positions;
  std::vector<double> u(phase.points()), stress(phase.points());
  phase.fields().point_displacement(simulation.t(), simulation.u(), u);
  phase.fields().point_stress(simulation.t(), simulation.u(), stress);
  double off = 0;
  for (std::size_t p = 0; p < X.size(); ++p) off += std::abs(stress[p] + s0 * (1 - X[p])) / s0;
  const auto top = static_cast<std::size_t>(std::ranges::max_element(X) - X.begin());
  return {simulation.summary(), off / static_cast<double>(X.size()), u[top] / exact_u(s0, X[top]) - 1};
}

}  // namespace

TEST_CASE("a column loaded at once or slowly by any way bears its weight within 2e-3 on 16 and 2e-4 on 64 cells") {
  for (const std::string rise : {"0.001", "40"}) {
    for (const std::string strategy : {"viscous", "kinetic", "one-sided", "auto"}) {
      for (const auto& [cells, stress] : {std::pair{16, 2e-3}, std::pair{64, 2e-4}}) {
        std::vector<std::string> set = {"constants.rise=" + rise, "damping={strategy='" + strategy + "'}"};
        if (strategy == "viscous") set.back() = "damping.c=critical";
        const Settled s = settled(4, cells, set);
        CAPTURE(rise, strategy, cells, s.stress_error, s.u_error, s.summary.reason);
        CHECK(s.summary.status == RunStatus::equilibrium);
        CHECK(s.summary.phases > 50);
        CHECK(s.stress_error <= stress);
        CHECK(std::abs(s.u_error) < 0.002);
      }
    }
  }
}

// By flip, a column that overshoots keeps in its shape what the points' velocities had and no function felt.
TEST_CASE(
    "affine velocities leave a column that is loaded at once less than 0.4 of the stress error that flip leaves") {
  for (const std::string strategy : {"kinetic", "one-sided"}) {
    const auto stress_error = [&](const char* transfer) {
      return settled(4, 64, {"damping={strategy='" + strategy + "'}", std::string("phase.transfer=") + transfer})
          .stress_error;
    };
    CAPTURE(strategy);
    CHECK(stress_error("apic") <= 0.4 * stress_error("flip"));
  }
}

TEST_CASE("deformation multiplied up from phase to phase keeps what a sudden load left, and the run says how much") {
  const Settled multiplied = settled(4, 16, {"phase.deformation=accumulated", "phase.transfer=flip"});
  CHECK(multiplied.stress_error > 0.02);
  REQUIRE(multiplied.summary.null_space_stress);
  CHECK(*multiplied.summary.null_space_stress > 0.02);
  const auto warns = [](const Summary& summary) {
    return std::ranges::any_of(summary.notes, [](const std::string& note) {
      return note.find("varies faster than the grid's functions") != std::string::npos &&
             note.find("phase.deformation") != std::string::npos;
    });
  };
  CHECK(warns(multiplied.summary));
  const Settled fitted = settled(4, 16, {"phase.transfer=flip"});
  CHECK_FALSE(warns(fitted.summary));
  REQUIRE(fitted.summary.null_space_stress);
  CHECK(*fitted.summary.null_space_stress < 0.2 * *multiplied.summary.null_space_stress);
}

// A function that the topmost domain hardly reaches is heavier than it is stiff, and comes to rest slowly.
TEST_CASE("72 Hencky columns in phases settle within 0.5 % of the exact answer, at most 3 of them too slowly") {
  int slow = 0;
  for (const std::string basis : {"quadratic", "cubic"}) {
    for (const double s0 : {0.25, 0.5, 1.0, 2.0}) {
      for (const int cells : {4, 6, 8, 12, 16, 24, 32, 48, 64}) {
        const Settled s = settled(s0, cells, {"grid.basis=" + basis, "body_force.value=['-s0']"});
        CAPTURE(basis, s0, cells, s.summary.reason, s.summary.phases);
        slow += s.summary.status == RunStatus::end_time;
        CHECK((s.summary.status == RunStatus::equilibrium || s.summary.status == RunStatus::end_time));
        CHECK(std::abs(s.u_error) < 0.005);
      }
    }
  }
  CHECK(slow <= 3);
}

TEST_CASE("16 Hencky columns on a linear basis settle within 0.5 % of the exact answer") {
  for (const double s0 : {0.25, 0.5, 1.0, 2.0}) {
    for (const int cells : {8, 16, 32, 64}) {
      const Settled s = settled(s0, cells, {"grid.basis=linear", "body_force.value=['-s0']"});
      CAPTURE(s0, cells, s.summary.reason, s.summary.phases);
      CHECK(s.summary.status == RunStatus::equilibrium);
      CHECK(std::abs(s.u_error) < 0.005);
    }
  }
}

TEST_CASE("with two points a cell 72 Hencky columns settle within 0.6 %, one of them too slowly, and none dances") {
  int slow = 0;
  for (const std::string basis : {"quadratic", "cubic"}) {
    for (const double s0 : {0.25, 0.5, 1.0, 2.0}) {
      for (const int cells : {4, 6, 8, 12, 16, 24, 32, 48, 64}) {
        const Settled s =
            settled(s0, cells, {"grid.basis=" + basis, "body_force.value=['-s0']", "body.points_per_cell=2"});
        CAPTURE(basis, s0, cells, s.summary.reason, s.summary.phases);
        slow += s.summary.status == RunStatus::end_time;
        CHECK((s.summary.status == RunStatus::equilibrium || s.summary.status == RunStatus::end_time));
        CHECK(std::abs(s.u_error) < 0.006);
        CHECK(s.summary.rhs_evaluations < 10'000);
      }
    }
  }
  CHECK(slow <= 1);
}
