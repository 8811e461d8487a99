// The work that is told beside the energy that there is.
#include <algorithm>
#include <cmath>
#include <optional>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "says.hpp"
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

TEST_CASE("loads and supports that a static solver lets come on in shares do the work that the body stores") {
  const std::string held = "support=[{face='bottom'}, {face='left', kind='roller'}, {face='top', kind='roller'",
                    pressed = held + ", u=-0.01}]", weightless = "body_force.value=[0, 0]";
  const std::string hung = "support=[{face='bottom'}, {face='left', kind='roller'}]";
  for (const char* method : {"newton", "cg", "lbfgs"}) {
    for (const auto& set : {std::vector<std::string>{hung}, {pressed, weightless}, {pressed}}) {
      for (const char* steps : {"1", "3"}) {
        CAPTURE(method, set, steps);
        Scene scene = scenes::load("column", scenes::with(set, {"grid.cells=[1, 8]", "stop.residual=1e-9",
                                                                std::string("solve.method=") + method,
                                                                std::string("solve.load_steps=") + steps}));
        scene.exact = {};
        Simulation simulation(scene);
        while (!simulation.done()) simulation.step();
        REQUIRE(simulation.summary().status == RunStatus::equilibrium);
        const double stored = strain_energy(simulation);
        CHECK(stored > 100);
        CHECK(*simulation.summary().external_work == Approx(stored).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("the work on a block that yields between the shares of a static solver's load is that along the shares") {
  // σ_xx = −p stays; under the plate σ_yy falls with the slope E/(1 − ν²) to where the block yields, and stays there.
  const std::string block =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [1.2, 1]\ncells = [6, 5]\n"
      "[body]\nmax = [1, 1]\nmaterial = 'm'\nstate = 'plane-strain'\npoints_per_cell = 4\nplacement = 'gauss'\n"
      "[material.m]\nlaw = 'mohr-coulomb'\nE = 2e7\nnu = 0.3\nrho = 1900\nc = 8e3\nphi = 25\n"
      "[mass]\nkind = 'lumped'\n[phase]\nmax_motion = 'none'\ndilatation = 'cells'\n"
      "[initial]\nstress = [-150e3, -150e3, -150e3, 0]\n"
      "[[support]]\nface = 'left'\nkind = 'roller'\n[[support]]\nface = 'bottom'\nkind = 'roller'\n"
      "[[traction]]\nline = [[1, 0], [1, 1]]\npressure = 150e3\n"
      "[[support]]\nface = 'top'\nkind = 'roller'\nu = -0.05\n"
      "[solve]\nmethod = 'newton'\nload_steps = 50\n[stop]\nresidual = 1e-10\n"
      "[[probe]]\nname = 'side'\nat = [1, 0.5]\nfields = ['u.x']\n"
      "[[probe]]\nname = 'middle'\nat = [0.5, 0.5]\nfields = ['stress.yy']\n";
  const Summary s = scenes::run_text(block);
  REQUIRE(s.status == RunStatus::equilibrium);
  constexpr double p = 150e3, slope = 2e7 / (1 - 0.3 * 0.3), u = 0.05;
  const double strength = -scenes::probe(s, "middle", "stress.yy");
  CHECK(strength == Approx(394.7e3).epsilon(1e-3));
  const double of_plate = strength * u - (strength - p) * (strength - p) / (2 * slope);
  // The plate's face widens as the side moves out, and that of the pressure becomes as much shorter as the plate moves.
  const double side = scenes::probe(s, "side", "u.x"), of_faces = (strength + p) * side * u / 2;
  CHECK(*s.external_work == Approx(of_plate - p * side + of_faces).epsilon(5e-3));
  CHECK_FALSE(test::says(s, "plastic flow out of balance"));  // in shares of a fiftieth the path is followed
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
