// Static solvers take the load in as many shares as a scene asks for.
#include <stillpoint/compare.hpp>
#include <stillpoint/static_solution.hpp>
#include <stillpoint/stillpoint.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "largest.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

TEST_CASE("the load in eight shares ends three times as near to that in 64 as in one, where points remember") {
  const auto by = [](const char* method, int shares) {
    Simulation simulation(scenes::load("footing", {fmt::format("solve.method={}", method),
                                                   fmt::format("solve.load_steps={}", shares), "stop.residual=1e-8"}));
    simulation.run();
    CHECK(simulation.status() == RunStatus::equilibrium);
    const ConstVec u = simulation.u();
    return std::vector<double>(u.begin(), u.end());
  };
  const std::vector<double> slow = by("newton", 64);
  for (const char* method : {"newton", "cg", "lbfgs"}) {
    CAPTURE(method);
    const double one = largest_difference(by(method, 1), slow), eight = largest_difference(by(method, 8), slow);
    CHECK(one > 1e-3 * largest_magnitude(slow));  // the path counts
    CHECK(eight < one / 3);
  }
}

TEST_CASE("a cylinder of clay near its limit has its answer by any number of shares, whose first steps are elastic") {
  for (const char* method : {"newton", "newton-cg", "cg"}) {
    for (const int shares : {1, 3, 5, 10, 30}) {
      CAPTURE(method, shares);
      const Summary s = run(scenes::load(
          "hard/clay_cylinder", {fmt::format("solve.method={}", method), fmt::format("solve.load_steps={}", shares)}));
      CAPTURE(s.reason);
      CHECK(s.status == RunStatus::equilibrium);
      CHECK(scenes::probe(s, "outside", "u.x") == Approx(1.5582e-6).epsilon(5e-4));
    }
  }
}

TEST_CASE("shares of the load are refused where they have no part") {
  CHECK_THAT(scenes::refusal("footing", {"solve.load_steps=4"}), Contains("solve.load_steps"));
  CHECK_THAT(scenes::refusal("footing", {"solve.method=newton", "solve.load_steps=0"}), Contains("solve.load_steps"));
  for (const char* method : {"newton-cg", "cg", "lbfgs"})
    CHECK(scenes::refusal("footing", {fmt::format("solve.method={}", method), "solve.load_steps=4"}).empty());
}

TEST_CASE("a comparison takes the shares that are asked for", "[compare]") {
  const auto steps = [](const char* shares) {
    const Comparison c = compare(scenes::load("footing", {"solve.method=newton", shares}),
                                 {.strategies = {"newton", "cg"}, .repeats = 0, .threads = 1});
    for (const ComparedRun& run : c.runs) {
      CAPTURE(run.reason);
      CHECK(run.status == ComparedStatus::converged);
    }
    return std::vector<long>{c.runs.at(0).steps, c.runs.at(1).steps};
  };
  const std::vector<long> eight = steps("solve.load_steps=8"), one = steps("solve.load_steps=1");
  CHECK(eight[0] > 2 * one[0]);
  CHECK(eight[1] > 2 * one[1]);
}

TEST_CASE("a support goes its way in the same shares as the load, so that points beside it remember no jump") {
  // The pressure in the cavity over c: of elastic clay 2 G ln(a/a_0) to the order of the strain, and a published one
  const double pi = std::acos(-1.0), G = 1e6, c = 1e4, height = 0.05;
  const auto pressure = [&](const std::string& method, double growth, const std::vector<std::string>& more) {
    std::vector<std::string> set = {fmt::format("solve.method={}", method), fmt::format("constants.growth={}", growth),
                                    "support[0].u=growth*a", "stop.time=100",
                                    fmt::format("solve.load_steps={}", method == "newton" ? 100 : 4)};
    set.insert(set.end(), more.begin(), more.end());
    const Summary s = run(scenes::load("ladder/cavity", set));
    CAPTURE(s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    return s.reactions.at("cavity").at(0) / (2 * pi * (1 + growth) * height);
  };
  // The way of the cavity is a fifth or a half of the cell beside it, which would be strained by that at once
  for (const auto& [method, cells] :
       {std::pair("newton", 80), std::pair("newton", 160), std::pair("cg", 80), std::pair("lbfgs", 80)}) {
    CAPTURE(method, cells);
    CHECK(pressure(method, 0.01, {fmt::format("constants.n={}", cells), "material.clay.c=1e9"}) ==
          Approx(0.0198018 * G).epsilon(1e-3));
  }
  CHECK(pressure("newton", 0.1, {"constants.n=80"}) == Approx(3.85640 * c).epsilon(0.01));
}

TEST_CASE("a solver that goes on from its answer leaves supports where they are") {
  const auto phase = make_phase(scenes::load("ladder/cavity", {"constants.n=80"}));
  std::vector<double> u(phase->size(), 0.0), strain(phase->points()), strain_again(phase->points());
  const NewtonOptions in_shares{.tolerance = 1e-8, .load_steps = 100, .max_load_step = 0.01};
  REQUIRE(newton(*phase, 1, u, in_shares).converged);
  phase->fields().point_history("plastic_strain", strain);
  const std::vector<double> first = u;
  REQUIRE(newton(*phase, 1, u, in_shares).converged);
  phase->fields().point_history("plastic_strain", strain_again);
  CHECK(largest_magnitude(strain) > 0.1);
  CHECK(largest_difference(u, first) < 1e-6 * largest_magnitude(first));
  CHECK(largest_difference(strain_again, strain) < 1e-6 * largest_magnitude(strain));
}
