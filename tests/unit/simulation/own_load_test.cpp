#include <stillpoint/own_load.hpp>
#include <stillpoint/scene_error.hpp>
#include <stillpoint/simulation.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const std::string heavy_column = STILLPOINT_PROBLEMS "/column.toml";  // under its own weight in the plane

// b = (0, −g(t) (1 + y))
void add_weight(const std::string& name, double settles_at, double (*g)(double)) {
  add_load({.name = name, .settles_at = settles_at}, [g](double t, int dim, ConstVec x, Vec b) {
    for (std::size_t i = 0; i < x.size(); i += static_cast<std::size_t>(dim)) {
      b[i] = 0;
      b[i + 1] = -g(t) * (1 + x[i + 1]);
    }
  });
}

std::vector<double> column_after(int steps, const std::vector<std::string>& overrides) {
  Simulation simulation(load_scene(heavy_column, overrides), {.threads = 1, .stops = false});
  for (int k = 0; k < steps; ++k) simulation.step();
  const ConstVec u = simulation.u();
  return {u.begin(), u.end()};
}

}  // namespace

TEST_CASE("a load that a program adds is the body force of the same formula, bit for bit, constant or not") {
  add_weight("steady", 0, [](double) { return 10.0; });
  CHECK(column_after(40, {"body_force.own=steady", "body_force.value=[0,0]"}) ==
        column_after(40, {"body_force.value=[0,\"-10*(1+y)\"]"}));
  add_weight("swinging", infinity, [](double t) { return 10 * std::cos(t); });
  CHECK(column_after(40, {"body_force.own=swinging", "body_force.value=[0,0]"}) ==
        column_after(40, {"body_force.value=[0,\"-10*cos(t)*(1+y)\"]"}));
}

TEST_CASE("Newton's method balances a load that a program adds, and its supports bear it") {
  add_weight("steady", 0, [](double) { return 10.0; });
  const auto at_rest = [](const std::string& load) {
    Simulation simulation(load_scene(heavy_column, {load, "solve.method=newton", "support[0].name=base"}));
    CHECK(simulation.run() == RunStatus::equilibrium);
    return simulation.summary();
  };
  const Summary own = at_rest("body_force={value=[0,0], own=\"steady\"}"),
                formula = at_rest("body_force={value=[0,\"-10*(1+y)\"]}");
  CHECK(own.residual <= 1e-9);
  // ∫ ρ 10 (1 + y) dV over 1.25 × 10 m: 2000 · 10 · 1.25 (10 + 50)
  CHECK(own.reactions.at("base").at(1) == Approx(1.5e6).epsilon(1e-3));  // cells integrate y to their middles
  CHECK(own.reactions.at("base").at(1) == Approx(formula.reactions.at("base").at(1)).epsilon(1e-12));
}

TEST_CASE("no equilibrium is found before a load that a program adds has settled") {
  add_weight("pause", 5, [](double t) { return t < 5 ? 5.0 : 10.0; });  // at rest under half of it long before
  Simulation simulation(load_scene(heavy_column, {"body_force={own=\"pause\"}", "stop.time=50", "output.every=1"}),
                        {.threads = 1});
  CHECK(simulation.run() == RunStatus::equilibrium);
  CHECK(simulation.t() > 5);
}

TEST_CASE("a load that is no number ends a run with its name, the time and the point") {
  add_load({.name = "hole", .settles_at = infinity}, [](double t, int, ConstVec, Vec b) {
    for (double& component : b) component = 1;
    if (t > 0.1) b[2 * 3 + 1] = std::numeric_limits<double>::quiet_NaN();
  });
  Simulation simulation(load_scene(heavy_column, {"body_force={own=\"hole\"}", "stop.time=50"}), {.threads = 1});
  CHECK(simulation.run() == RunStatus::diverged);
  INFO(simulation.reason());
  CHECK(simulation.reason().find("body_force.own is not a number at t = ") != std::string::npos);
  CHECK(simulation.reason().find("material point") != std::string::npos);
}

TEST_CASE(
    "a scene that names a load that was not added, or one that varies where it may not, is refused where it says so") {
  add_weight("steady", 0, [](double) { return 10.0; });
  add_weight("swinging", infinity, [](double t) { return 10 * std::cos(t); });
  const auto refusal = [](const std::vector<std::string>& overrides) -> std::string {
    try {
      load_scene(heavy_column, overrides);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  CHECK(refusal({"body_force={own=\"steadi\"}"}).find("there is no load 'steadi'; did you mean 'steady'?") !=
        std::string::npos);
  const std::string driven = "load={displacement=\"t\"}";
  CHECK(refusal({"body_force={own=\"swinging\"}", driven, "stop.time=1"}).find("'swinging', depends on t") !=
        std::string::npos);
  CHECK(refusal({"body_force={own=\"steady\"}", driven, "stop.time=1"}).find("depends on t") == std::string::npos);
  CHECK_THROWS_AS(add_weight("Two words", 0, nullptr), std::invalid_argument);
  CHECK_THROWS_AS(add_weight("early", -1, nullptr), std::invalid_argument);
  CHECK_THROWS_AS(add_weight("never", std::numeric_limits<double>::quiet_NaN(), nullptr), std::invalid_argument);
}
