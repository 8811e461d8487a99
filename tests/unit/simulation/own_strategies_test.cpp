#include <stillpoint/own_damping.hpp>
#include <stillpoint/own_relaxation.hpp>
#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "plan/catalogue.hpp"

using namespace stillpoint;

namespace {

const std::string bar_file = STILLPOINT_PROBLEMS "/bar.toml";

void cundall(double alpha, ConstVec v, ConstVec Q, Vec D) {
  for (std::size_t i = 0; i < v.size(); ++i) D[i] = -alpha * std::abs(Q[i]) * (v[i] > 0 ? 1.0 : v[i] < 0 ? -1.0 : 0.0);
}

// Gradient descent, v⁺ = h/4 M⁻¹Q, which counts.
struct Descent : OwnRelaxation {
  void propose(double h, const MotionNow& now, Vec u_new, Vec v_new) override {
    for (std::size_t i = 0; i < u_new.size(); ++i) {
      v_new[i] = h / 4 * now.a[i];
      u_new[i] = now.u[i] + h * v_new[i];
    }
  }
};

std::vector<double> bar_after(int steps, const std::vector<std::string>& overrides) {
  Simulation simulation(load_scene(bar_file, overrides), {.threads = 1});
  for (int k = 0; k < steps; ++k) simulation.step();
  const ConstVec u = simulation.u();
  return {u.begin(), u.end()};
}

}  // namespace

TEST_CASE("a damping that a program adds takes the steps of the built-in one with the same formula, bit for bit") {
  add_damping({.name = "own-cundall", .equation = "as cundall", .stiffness_factor = 1.7}, cundall);
  const auto of = [](const std::string& name) {
    return bar_after(100, {"damping.strategy=" + name, "damping.alpha=0.7", "mass.kind=lumped"});
  };
  CHECK(of("own-cundall") == of("cundall"));
  REQUIRE(catalogue().strategy("own-cundall"));
  CHECK(catalogue().strategy("own-cundall")->equation == "as cundall");
}

TEST_CASE("a relaxation that a program adds is made anew for each simulation, and moves as it proposes") {
  int made = 0;
  add_relaxation({.name = "own-descent"}, [&made] {
    ++made;
    return std::make_unique<Descent>();
  });
  const std::vector<std::string> overrides = {"damping.strategy=own-descent"};
  CHECK(bar_after(1, overrides) != bar_after(2, overrides));
  CHECK(made == 2);
  Simulation simulation(load_scene(bar_file, overrides), {.threads = 1});
  simulation.step();
  CHECK(simulation.evaluations() == 2);
  const double first = simulation.residual();
  for (int k = 0; k < 200; ++k) simulation.step();
  CHECK(simulation.residual() < first);
}

TEST_CASE("a name that the library or the other kind has is refused, and so is one that is no word") {
  add_damping({.name = "own-force"}, cundall);
  const auto make = [] { return std::make_unique<Descent>(); };
  for (const std::string name : {"auto", "viscous", "newton-cg", "own-force", "Upper", "", "-a"})
    CHECK_THROWS_AS(add_relaxation({.name = name}, make), std::invalid_argument);
  CHECK_THROWS_AS(add_damping({.name = "kinetic"}, cundall), std::invalid_argument);
  CHECK_THROWS_AS(add_damping({.name = "own-force", .stiffness_factor = 0.5}, cundall), std::invalid_argument);
  CHECK_NOTHROW(add_damping({.name = "own-force"}, cundall));
}

TEST_CASE("rows of the catalogue that somebody points to stay when a program adds others") {
  const StrategyInfo* const viscous = catalogue().strategy("viscous");
  const RelaxationInfo* const kinetic = find_relaxation("kinetic");
  for (int k = 0; k < 50; ++k) add_damping({.name = "own-" + std::to_string(k)}, cundall);
  CHECK(viscous->name == "viscous");
  CHECK(kinetic->about.name == "kinetic");
  CHECK(catalogue().strategy("own-49"));
}

TEST_CASE("a stopping test of a program's own ends the simulation with its reason, and status 0") {
  SimulationOptions options{.threads = 1};
  int asked = 0;
  options.stop_test = [&asked] { return ++asked < 7 ? std::string() : "seven steps"; };
  Simulation simulation(load_scene(bar_file), options);
  CHECK(simulation.run() == RunStatus::stop_test);
  CHECK(simulation.reason() == "seven steps");
  CHECK(simulation.steps() == 7);
  CHECK(simulation.summary().exit_status == 0);
}

TEST_CASE("a state that is held outlives its simulation and its phase") {
  std::shared_ptr<const Vector> y;
  std::vector<double> last;
  {
    Simulation simulation(load_scene(STILLPOINT_PROBLEMS "/hard/column_in_phases.toml"), {.threads = 1});
    y = simulation.state();
    while (simulation.phases() == 1 && !simulation.done()) {
      last.assign(y->span().begin(), y->span().end());
      simulation.step();
    }
    CHECK(simulation.phases() == 2);
    CHECK(simulation.state() != y);
  }
  CHECK(y->size() == last.size());
  CHECK(std::ranges::all_of(y->span(), [](double value) { return std::isfinite(value); }));
}

TEST_CASE("the rows of the history are told without files") {
  SimulationOptions options{.threads = 1};
  std::vector<std::string> names;
  std::vector<double> times;
  options.at_row = [&](const std::vector<std::string>& columns, const std::vector<double>& row) {
    names = columns;
    times.push_back(row.front());
    CHECK(row.size() == columns.size());
  };
  Simulation simulation(load_scene(bar_file), options);
  simulation.run();
  CHECK(names.front() == "t");
  CHECK(names.at(5) == "p6.u");
  CHECK(std::ranges::is_sorted(times));
  CHECK(times.back() == simulation.t());
}
