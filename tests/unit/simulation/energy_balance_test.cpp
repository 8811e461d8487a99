// The work that is told beside the energy that there is.
#include <algorithm>
#include <cmath>
#include <optional>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

// ½ Σ_p V_p σ : ε
double strain_energy(Simulation& simulation) {
  const auto copy = [&](const char* name) {
    const ConstVec field = simulation.field(name);
    return std::vector<double>(field.begin(), field.end());
  };
  const std::vector<double> H = copy("strain"), s = copy("stress"),
                            V = simulation.parts().phase.fields().point_data().volumes;
  double energy = 0;
  for (std::size_t p = 0; p < V.size(); ++p) {  // xx, xy, yx, yy of ∂u/∂x; xx, yy, zz, xy of σ
    const double *h = &H[4 * p], *of = &s[4 * p];
    energy += V[p] / 2 * (of[0] * h[0] + of[1] * h[3] + of[3] * (h[1] + h[2]));
  }
  return energy;
}

struct Balance {
  double largest_energy = 0, largest_error = 0, work = 0;
};

// Kinetic and strain energy, and what a damping C = c M has taken, ∫ 2 c T dt, beside the work, at every step.
Balance balance_of(const std::vector<std::string>& more, double step, double c = 0,
                   double max_motion = PhaseSpec::never) {
  std::vector<std::string> set = {"grid.cells=[1, 8]", "stop.residual=0", "stop.time=0.5",
                                  "integrator.step=" + std::to_string(step), "output.every=" + std::to_string(step)};
  set.insert(set.end(), more.begin(), more.end());
  Scene scene = scenes::load("column", set);
  scene.exact = {};  // of the column's own weight
  scene.phase.max_motion = max_motion;
  Simulation simulation(scene);
  Balance balance;
  double damped = 0, last = 0;
  while (!simulation.done()) {
    simulation.step();
    const Summary s = simulation.summary();
    damped += step * c * (s.kinetic_energy + last);
    last = s.kinetic_energy;
    double energy = s.kinetic_energy + strain_energy(simulation) + damped;
    for (const SupportGap& pin : s.weak_supports) energy += pin.stiffness * pin.gap * pin.gap / 2;
    balance.work = *s.external_work;
    balance.largest_energy = std::max(balance.largest_energy, std::abs(energy));
    balance.largest_error = std::max(balance.largest_error, std::abs(energy - balance.work));
  }
  return balance;
}

const std::string shaken = "support=[{face='bottom', u='0.01*sin(20*t)'}, {face='left', kind='roller'}]";

}  // namespace

TEST_CASE("the work of loads and moving supports is the energy that there is, and what damping takes") {
  const std::string none = "damping={strategy='none'}", viscous = "damping={strategy='viscous', c=5.0}";
  for (const char* weight : {"body_force.value=[0, 0]", "body_force.value=[0, '-g']"}) {
    CAPTURE(weight);
    const Balance coarse = balance_of({weight, shaken, none}, 5e-4), fine = balance_of({weight, shaken, none}, 2.5e-4);
    CHECK(fine.largest_energy > 1e3);
    CHECK(fine.largest_error < 1e-3 * fine.largest_energy);
    CHECK(fine.largest_error < 0.35 * coarse.largest_error);  // of second order, by the trapezoidal rule
    const Balance damped = balance_of({weight, shaken, viscous}, 2.5e-4, 5.0);
    CHECK(damped.largest_error < 1e-3 * damped.largest_energy);
  }
}

TEST_CASE("what a moving pin does on its spring is the energy of the body and of the spring") {
  const Balance balance = balance_of({"body_force.value=[0, 0]", "damping={strategy='none'}",
                                      "support=[{face='bottom'}, {face='left', kind='roller'}, "
                                      "{at=[0.3, 6.3], component='y', u='0.01*sin(20*t)'}]"},
                                     2.5e-4);
  CHECK(balance.largest_energy > 1e2);
  CHECK(balance.largest_error < 2e-3 * balance.largest_energy);
}

TEST_CASE("a support that is displaced from the start has done the work of the strain that it brought") {
  const Balance balance = balance_of({"body_force.value=[0, 0]", "damping={strategy='none'}",
                                      "support=[{face='bottom', u=0.01}, {face='left', kind='roller'}]"},
                                     2.5e-4);
  CHECK(balance.work > 1e3);
  CHECK(balance.largest_error < 2e-3 * balance.work);
}

TEST_CASE("the work of a moving support goes on from phase to phase, with any integrator") {
  const std::vector<std::string> set = {"material.soil={law='hencky', E='E', nu='nu', rho='rho'}",
                                        "grid.basis=quadratic",
                                        shaken,
                                        "body_force.value=[0, 0]",
                                        "grid.max=[1.25, 11]",
                                        "body.max=[1.25, 10]",
                                        "damping={strategy='viscous', c=5.0}"};
  std::vector<std::string> runge_kutta = set;
  runge_kutta.emplace_back("integrator.method=erk:rk4");
  const Balance one = balance_of(set, 5e-4);
  CHECK(one.work > 1e3);
  for (const auto& several : {set, runge_kutta})
    CHECK(balance_of(several, 5e-4, 5, 0.005).work == Approx(one.work).epsilon(0.02));
}

TEST_CASE("a kinetic energy beside no work is not called a share of it") {
  const TemporaryFolder folder;
  const Summary s = run(
      scenes::load("column", {"support=[]", "body_force.value=[0, 0]", "initial.v=[0, 1]", "damping={strategy='none'}",
                              "stop.residual=0", "stop.time=0.01", "output.every=0.005"}),
      {.out = folder.path()});
  CHECK(*s.external_work == 0);
  CHECK(s.kinetic_energy > 0);
  const std::string history = test::contents(folder.path() / "history.csv");
  CHECK_THAT(history, Catch::Contains(",0,nan") && !Catch::Contains("inf"));
}
