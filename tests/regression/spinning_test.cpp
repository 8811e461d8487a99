// A square and a cube that spin freely, in phases: what a turn keeps of their motion, and their centrifugal stress.
#include <stillpoint/stillpoint.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "largest.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;

namespace {

constexpr double square_side = 1, spin_rate = 1, whole_turn = 6.283185307179586;
constexpr double energy_at_start = spin_rate * spin_rate * square_side * square_side / 12;  // ½ Ω² ∫ρ r² dA, ρ = 1

/// The square, or a quarter of it.
Scene square(const std::string& basis, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"grid.cells=[24, 24]", "grid.basis=" + basis});
  return scenes::load("hard/spinning_square", overrides);
}

/// ½ Σ m_p |v_p|² and the sums of stresses σ_xx + σ_yy, which a rotation of the axes leaves as they are: their mean
/// over the body, and over the four points about its middle.
struct SpinState {
  double energy = 0, trace = 0, trace_in_the_middle = 0;
};

SpinState state_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec v) {
  const std::size_t n = phase.points();
  std::vector<double> of_velocity(2 * n), place(2 * n),
      stress(n * static_cast<std::size_t>(phase.info().stress_components));
  phase.fields().point_field(PointQuantity::velocity, t, v, of_velocity);
  phase.fields().point_field(PointQuantity::stress, t, u, stress);
  const PointData data = phase.fields().point_data();
  SpinState state;
  std::vector<std::array<double, 2>> by_distance;
  for (std::size_t p = 0; p < n; ++p) {
    const double* s = stress.data() + p * static_cast<std::size_t>(phase.info().stress_components);
    const double trace = s[0] + s[1];
    state.energy += data.masses[p] * (std::pow(of_velocity[2 * p], 2) + std::pow(of_velocity[2 * p + 1], 2)) / 2;
    state.trace += trace / static_cast<double>(n);
    by_distance.push_back({std::hypot(data.positions[2 * p], data.positions[2 * p + 1]), trace});
  }
  std::ranges::sort(by_distance);
  for (std::size_t p = 0; p < 4; ++p) state.trace_in_the_middle += by_distance[p][1] / 4;
  return state;
}

struct Turn {
  double kept = 0, most = 0;                  // of the energy
  double trace = 0, trace_in_the_middle = 0;  // mean over the turn
  double angular_momentum_error = 0;
};

/// A turn of the square, looked at so often that its vibrations, about 80, do not count in the means.
Turn spin(const std::string& basis, const std::string& transfer) {
  Simulation simulation(square(basis, {"body.min=[-0.5, -0.5]", "body.max=[0.5, 0.5]", "phase.transfer=" + transfer}),
                        {.threads = 1, .records = false});
  constexpr int looks = 300;
  Turn result;
  for (int k = 1; k <= looks; ++k) {
    simulation.run_until(whole_turn * k / looks);
    const SpinState now = state_of(simulation.parts().phase, simulation.t(), simulation.u(), simulation.v());
    result.kept = now.energy / energy_at_start;
    result.most = std::max(result.most, result.kept);
    result.trace += now.trace / looks;
    result.trace_in_the_middle += now.trace_in_the_middle / looks;
  }
  REQUIRE(simulation.status() == RunStatus::end_time);
  result.angular_momentum_error = simulation.summary().angular_momentum_error.value();
  return result;
}

/// σ_xx + σ_yy in the middle of the square under Ω² r, a quarter of it at rest in a single phase.
double static_trace_in_the_middle() {
  const Scene scene =
      square("quadratic", {"grid.min=[0, 0]", "grid.max=[0.5, 0.5]", "body.min=[0, 0]", "body.max=[0.5, 0.5]",
                           "phase.max_motion=none", "material.steel.law=linear-elastic", "initial.v=[0, 0]",
                           "body_force.value=['omega^2*x', 'omega^2*y']",
                           "support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                           "damping={strategy='viscous', c='critical'}", "stop={residual=1e-10}"});
  Simulation simulation(scene, {.threads = 1, .records = false});
  REQUIRE(simulation.run() == RunStatus::equilibrium);
  return state_of(simulation.parts().phase, simulation.t(), simulation.u(), simulation.v()).trace_in_the_middle;
}

}  // namespace

TEST_CASE("a square that spins a turn keeps its energy, never gains any, and bears its centrifugal stress") {
  // ∫σ_ij dA = ∫ρ Ω² x_i x_j dA, the virial theorem.
  constexpr double mean_trace = spin_rate * spin_rate * square_side * square_side / 6;
  const double in_the_middle = static_trace_in_the_middle();
  CHECK(in_the_middle > 1.5 * mean_trace);  // it is largest there
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string transfer : {"flip", "apic"}) {
      if (basis == "linear" && transfer == "apic") continue;  // of a stiff square it gains energy, which a note says
      CAPTURE(basis, transfer);
      const Turn of = spin(basis, transfer);
      CHECK(of.kept > (transfer == "flip" ? 0.95 : 0.98));  // 0.957 to 0.968, and 0.995
      CHECK(of.most < 1.01);
      CHECK(of.angular_momentum_error < (transfer == "flip" ? 0.02 : 1e-10));
      CHECK(of.trace == Approx(mean_trace).epsilon(0.05));
      if (basis == "linear") continue;  // its points cross cells
      CHECK(of.trace_in_the_middle == Approx(in_the_middle).epsilon(0.05));
    }
  }
}

namespace {

/// To a share of a turn, or of several.
void spin_on(Simulation& simulation, double turns) { simulation.run_until(whole_turn * turns); }

}  // namespace

TEST_CASE("a cube that spins about an axis askew in space keeps its motion and bears its centrifugal stress") {
  constexpr double a = 1, mean_trace = spin_rate * spin_rate * a * a / 6;  // ∫σ_ii dV = ∫ρ (Ω × x)² dV
  constexpr double energy = a * a * a * a * a / 12;                        // ½ Ω² m a²/6
  struct Case {
    std::string law, cells;
    double turns;
  };
  for (const auto& [law, cells, turns] : {Case{"neo-hookean", "[12, 12, 12]", 0.15}, {"hencky", "[8, 8, 8]", 0.05}}) {
    CAPTURE(law);
    Simulation simulation(scenes::load("hard/spinning_cube", {"grid.cells=" + cells, "material.steel.law=" + law,
                                                              fmt::format("constants.turns={}", turns)}),
                          {.threads = 1, .records = false});
    constexpr int looks = 50;
    const std::size_t points = simulation.points();
    double trace = 0;
    const auto kinetic_energy = [&] {  // of points of one mass
      double sum = 0;
      for (const double v : simulation.field("v")) sum += v * v;
      return sum / static_cast<double>(points) * a * a * a / 2;
    };
    const double at_start = kinetic_energy();
    CHECK(at_start == Approx(energy).epsilon(0.06));  // Σ m x² of points is short of that of their cells
    for (int k = 1; k <= looks; ++k) {
      spin_on(simulation, turns * k / looks);
      const ConstVec stress = simulation.field("stress");
      for (std::size_t p = 0; p < points; ++p)
        trace += (stress[6 * p] + stress[6 * p + 1] + stress[6 * p + 2]) / static_cast<double>(points * looks);
    }
    REQUIRE(simulation.status() == RunStatus::end_time);
    const Summary s = simulation.summary();
    CHECK(s.phases > 4);
    const double kept = kinetic_energy() / at_start;
    CHECK(kept > 0.95);
    CHECK(kept < 1.01);
    CHECK(s.momentum_error.value() < 1e-12);
    CHECK(s.angular_momentum_error.value() < 0.03);
    CHECK(trace == Approx(mean_trace).epsilon(0.1));
  }
}

TEST_CASE("a cube in free flight through the grid in space keeps its momentum, its shape and no stress") {
  for (const std::string transfer : {"flip", "pic", "apic", "xpic"}) {
    CAPTURE(transfer);
    Simulation simulation(scenes::load("hard/spinning_cube", {"grid.cells=[8, 8, 8]", "material.steel.law=neo-hookean",
                                                              "initial.v=['0.2', '-0.3', '0.5']",
                                                              "phase.transfer=" + transfer, "stop.time=0.8"}),
                          {.threads = 1, .records = false});
    simulation.run();
    REQUIRE(simulation.status() == RunStatus::end_time);
    CHECK(simulation.summary().phases > 10);
    const ConstVec u = simulation.field("u");
    Largest off;
    for (std::size_t k = 0; k < u.size(); ++k) off.take_magnitude(u[k] - 0.8 * std::array{0.2, -0.3, 0.5}[k % 3]);
    // Rounding grows where points cross the cells of a linear basis, in the plane too, with apic most.
    CHECK(off.value() < 1e-6);
    CHECK(largest_magnitude(simulation.field("stress")) < 5e-5 * 500);  // E
    CHECK(simulation.summary().momentum_error.value() < 1e-12);
  }
}
