// A load of a program's own is taken at its word when it has settled, where that can be.
#include <stillpoint/own_load.hpp>
#include <stillpoint/scene_error.hpp>
#include <stillpoint/simulation.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

const std::string column_file = STILLPOINT_PROBLEMS "/column.toml";

void add(const std::string& name, double settles_at, double (*g)(double)) {
  add_load({.name = name, .settles_at = settles_at}, [g](double t, int dim, ConstVec x, Vec b) {
    for (std::size_t i = 0; i < x.size(); i += static_cast<std::size_t>(dim)) {
      b[i] = 0;
      b[i + 1] = -g(t);
    }
  });
}

std::string refusal(const std::string& load, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"body_force={own=\"" + load + "\"}"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  try {
    const Simulation simulation(load_scene(column_file, overrides), {.threads = 1});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE(
    "a load that goes on after it is said to have settled is refused with the times of both, with and without an end") {
  add("growing", 0, [](double t) { return 10 + 0.1 * t; });
  add("swinging-on", 0, [](double t) { return 10 + std::sin(t); });
  add("too-late", 2, [](double t) { return 10 * std::min(t / 3, 1.0); });
  for (const char* load : {"growing", "swinging-on", "too-late"}) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"stop.time=50"}}) {
      const std::string said = refusal(load, more);
      CAPTURE(load, said);
      CHECK(said.find("is said to settle at t = ") != std::string::npos);
      CHECK(said.starts_with("--set body_force="));  // where it was asked for
    }
  }
}

TEST_CASE("a load that keeps its word is accepted, and one that says that it never settles") {
  add("steady-one", 0, [](double) { return 10.0; });
  add("in-time", 3, [](double t) { return 10 * std::min(t / 3, 1.0); });
  add("never", std::numeric_limits<double>::infinity(), [](double t) { return 10 + 0.1 * t; });
  for (const char* load : {"steady-one", "in-time", "never"}) {
    CHECK(refusal(load) == "accepted");
    CHECK(refusal(load, {"stop.time=50"}) == "accepted");
  }
}

TEST_CASE("a load that was changed from outside on the way is no equilibrium") {
  static double weight = 10;
  weight = 10;
  add("changed", 0, [](double) { return weight; });
  Simulation simulation(load_scene(column_file, {"body_force={own=\"changed\"}", "solve.method=relaxation"}),
                        {.threads = 1});
  weight = 11;
  CHECK(simulation.run() == RunStatus::failed);
  INFO(simulation.reason());
  CHECK(simulation.reason().find("body_force.own: the load 'changed'") != std::string::npos);
}
