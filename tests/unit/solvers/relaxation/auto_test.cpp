// When auto moves and how, and the mass that it chooses.
#include <stillpoint/state_norms.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "solvers/relaxation/relaxing.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

/// A chain whose forces are never better than to an amplitude: equilibrium cannot be approached further.
class NoisyChain final : public Chain {
 public:
  using Chain::Chain;
  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
    const bool ok = Chain::internal_force(t, u, R, trial);
    for (double& r : R) r += 1e-3 * (2 * static_cast<double>(random_()) / 4294967295.0 - 1);
    return ok;
  }

 private:
  mutable std::mt19937 random_{3};
};

}  // namespace

TEST_CASE("auto moves on from where the stiffness is negative, and ends where it is positive", "[strategies]") {
  Chain chain({.n = 8, .stiffness = -1, .cubic = 1, .load = 0.01});  // stable at extensions past 1/√3
  Relaxing relaxing(chain, {.strategy = "auto"}, 0.2);
  bool moved = false, settled = false;
  for (int k = 0; k < 5000 && !settled; ++k) {
    relaxing.step();
    moved = moved || relaxing.stepper->moves();
    settled = !relaxing.stepper->moves() && StateNorms(relaxing.system).last_residual() < 1e-10;
  }
  CHECK(moved);
  CHECK(settled);
  for (std::size_t i = 0; i < chain.size(); ++i)
    CHECK(std::abs(relaxing.y[i] - (i > 0 ? relaxing.y[i - 1] : 0)) > 1 / std::sqrt(3.0));
}

TEST_CASE("auto has a motion only where loads vary, another phase may follow, or points remember or touch",
          "[strategies]") {
  const auto moves = [](const RelaxationOptions& options) {
    Chain chain({.load = 1});
    return Relaxing(chain, {.strategy = "auto", .options = options}, 0.5).stepper->moves();
  };
  CHECK_FALSE(moves({}));
  CHECK(moves({.steady = false}));
  CHECK(moves({.single_phase = false}));
  const auto scene_moves = [](const std::string& name, std::vector<std::string> set = {}) {
    set.emplace_back("damping.strategy=auto");
    return Simulation(scenes::load(name, set), {.records = false}).stepper().moves();
  };
  CHECK_FALSE(scene_moves("block"));
  CHECK(scene_moves("footing"));
  CHECK(scene_moves("block_on_wall", {"stop.residual=1e-6", "stop.time=0"}));
  CHECK(scene_moves("ladder/compaction"));
  CHECK(scene_moves("hard/load_that_changes"));
}

TEST_CASE("auto scales the mass where that makes the condition number smaller, and says so", "[strategies]") {
  const auto note_of = [](const std::vector<std::string>& more) {
    std::vector<std::string> set = {"damping.strategy=auto"};
    set.insert(set.end(), more.begin(), more.end());
    const Model model = make_model(scenes::load("neo_hookean_bar", set));
    for (const std::string& note : model.notes) {
      if (note.starts_with("auto")) return note;
    }
    return std::string();
  };
  CHECK_THAT(note_of({}), Catch::Contains("Gershgorin"));
  CHECK(note_of({"mass.scaling=1", "mass.kind=lumped"}).empty());
  CHECK(note_of({"mass.kind=consistent"}).empty());
  CHECK_THAT(note_of({"stop.residual=0", "stop.time=1"}), Catch::Contains("physical mass"));
}

TEST_CASE("the motion of auto recovers from a step past the critical one", "[strategies]") {
  Chain chain({.n = 40, .left_held = true, .right_held = true, .load = 1e-3});
  const Values solution = static_solution(chain);
  const double omega_max = chain.exact_omega(40);
  CHECK(evaluations_to(1e-6, chain, solution, omega_max,
                       {.strategy = "auto", .step_fraction = 1.2, .options = {.single_phase = false}}, 2000) < 1000);
}

TEST_CASE("a motion of auto that makes no way any more gives up its c, and takes it up again where that does not help",
          "[strategies]") {
  NoisyChain chain({.n = 40, .left_held = true, .right_held = true, .load = 1});
  Relaxing relaxing(chain, {.strategy = "auto", .options = {.single_phase = false}}, 0.95 * 2 / chain.exact_omega(40));
  std::vector<int> changes;
  bool damped = true;
  int without = 0;
  for (int k = 0; k < 6000; ++k) {
    relaxing.step();
    without = *relaxing.stepper->damping_rate() == 0 ? without + 1 : 0;
    const bool now = without < 50;  // a quotient may be negative for a step
    if (now != damped) changes.push_back(k);
    damped = now;
  }
  CHECK(changes.size() >= 2);
  CHECK(relative_distance(relaxing.y, static_solution(Chain(chain.options()))) < 1e-2);
}

TEST_CASE("auto without a steady pull halts nothing: its motion is that of adaptive damping", "[strategies]") {
  const auto motion = [](const std::string& strategy, bool steady) {
    Chain chain({.n = 10, .cubic = 5});
    Values uphill(2 * chain.size());
    std::ranges::fill(second_half(Vec(uphill)), 1.0);
    Relaxing relaxing(chain, {.strategy = strategy, .options = {.steady = steady}}, 0.1, uphill);
    for (int k = 0; k < 200; ++k) relaxing.step();
    return relaxing.y;
  };
  CHECK(motion("auto", false) == motion("adaptive", true));
  CHECK(motion("auto", true) != motion("adaptive", true));
}
