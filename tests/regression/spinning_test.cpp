// A square that spins freely, in phases: what a turn keeps of its motion, and its centrifugal stress.
#include <stillpoint/stillpoint.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;

namespace {

constexpr double side = 1, omega = 1, turn = 6.283185307179586;
constexpr double energy_at_start = omega * omega * side * side / 12;  // ½ Ω² ∫ρ r² dA, ρ = 1

/// The square, or a quarter of it.
Scene square(const std::string& basis, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"grid.cells=[24, 24]", "grid.basis=" + basis});
  return scenes::load("hard/spinning_square", overrides);
}

/// ½ Σ m_p |v_p|² and the sums of stresses σ_xx + σ_yy, which a rotation of the axes leaves as they are: their mean
/// over the body, and over the four points about its middle.
struct State {
  double energy = 0, trace = 0, trace_in_the_middle = 0;
};

State state_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec v) {
  const std::size_t n = phase.points();
  std::vector<double> of_velocity(2 * n), place(2 * n),
      stress(n * static_cast<std::size_t>(phase.info().stress_components));
  phase.point_field(PointQuantity::velocity, t, v, of_velocity);
  phase.point_field(PointQuantity::stress, t, u, stress);
  const PointData data = phase.point_data();
  State state;
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
    simulation.run_until(turn * k / looks);
    const State now = state_of(simulation.phase(), simulation.t(), simulation.u(), simulation.v());
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
  return state_of(simulation.phase(), simulation.t(), simulation.u(), simulation.v()).trace_in_the_middle;
}

}  // namespace

TEST_CASE("a square that spins a turn keeps its energy, never gains any, and bears its centrifugal stress") {
  // ∫σ_ij dA = ∫ρ Ω² x_i x_j dA, the virial theorem.
  constexpr double mean_trace = omega * omega * side * side / 6;
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
