// Where bodies lie beside walls and supports: problems/hard/block_on_floor.toml.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;
using Catch::Contains;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double top = -0.002;  // −ρ g H²/(2 E)
constexpr double cell = 0.5;    // of the grid
constexpr double penetration = 1e-9 * cell;

Scene block(std::vector<std::string> overrides) { return scenes::load("hard/block_on_floor", overrides); }

const std::vector<std::string> strategies{"auto", "viscous", "kinetic", "one-sided", "cundall", "adaptive"};

std::vector<std::string> with(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// By a strategy; viscous with a rate that any body of this size comes to rest with, since nothing holds the block.
std::vector<std::string> by(const std::string& strategy) {
  std::vector<std::string> overrides{"damping.strategy=" + strategy, "stop.steps=400000"};
  if (strategy == "viscous") overrides.emplace_back("damping.c=10");
  return overrides;
}

}  // namespace

TEST_CASE("an elastic block comes to rest on a smooth floor where it belongs, whichever way it came there") {
  const std::vector<std::vector<std::string>> ways{
      {},
      {"body_force.value=[0, '-1 + 20*(t<0.5)']", "stop.time=200"},  // lifted for a while
      {"initial.v=[0, 5]"},                                          // thrown up
      {"initial.u=[0, 0.1]"},                                        // let fall
      {"initial.u=[0, -0.1]"},                                       // pushed into the floor
      {"initial.u=[0, '0.05*(x - 1)']"},                             // tilted
      {"initial.v=['0', '2*(x - 1)']"},                              // turned over its edge
      {"body_force.value=[0, '-1 - 30*(t<0.2)']", "stop.time=200"},  // pressed, and thrown up by itself
  };
  for (const std::string& strategy : strategies) {
    for (const auto& way : ways) {
      for (const char* basis : {"linear", "quadratic"}) {
        CAPTURE(strategy, way, basis);
        const Summary s = run(block(with(with(by(strategy), way), {std::string("grid.basis=") + basis})));
        CAPTURE(s.reason);
        if (s.status == RunStatus::step_limit) continue;  // slow is not false
        REQUIRE((s.status == RunStatus::equilibrium || s.status == RunStatus::end_time));
        CHECK_THAT(scenes::probe(s, "bottom", "u.y"), WithinAbs(0, penetration));
        const double share = 1e-6;  // of the displacement: what a residual of 1e-9 leaves
        CHECK_THAT(scenes::probe(s, "top", "u.y"), WithinAbs(top, share * std::abs(top)));
      }
    }
  }
}

TEST_CASE("a wall is where its motion says, whether that is constant, begins elsewhere, jumps or comes back") {
  struct Way {
    std::string motion;
    double end;
  };
  for (const Way& way :
       {Way{"0.1", 0.1}, Way{"-0.1", -0.1}, Way{"0.1*(t>=1)", 0.1}, Way{"-0.1*(t>=1)", -0.1},
        Way{"0.05 + 0.05*min(t,1)", 0.1}, Way{"0.2*min(t,1) - 0.1*min(max(t-2,0),1)", 0.1}, Way{"0.1*(t<1)", 0}}) {
    for (const std::string& strategy : strategies) {
      CAPTURE(strategy, way.motion);
      const Summary s = run(block(with(by(strategy), {"wall[0].motion='" + way.motion + "'", "stop.time=200"})));
      CAPTURE(s.reason);
      CHECK_THAT(scenes::probe(s, "bottom", "u.y"), WithinAbs(way.end, penetration));
      const double share = 1e-5;  // of the displacement: some damp little on a floor that no support holds
      CHECK_THAT(scenes::probe(s, "top", "u.y") - way.end, WithinAbs(top, share * std::abs(top)));
    }
  }
}

TEST_CASE("a body that falls onto a wall in phases comes to rest on it") {
  const std::vector<std::string> falling{"material.block.law=hencky", "phase.max_motion=0.1", "stop.residual=1e-7"};
  for (const char* gap : {"1", "0.4", "0.07", "1.23"}) {
    for (const char* basis : {"linear", "quadratic", "cubic"}) {
      for (const char* strategy : {"kinetic", "auto", "cundall"}) {
        CAPTURE(gap, basis, strategy);
        const Summary s = run(block(with(with(by(strategy), falling),
                                         {std::string("constants.gap=") + gap, std::string("grid.basis=") + basis})));
        CAPTURE(s.reason);
        CHECK(s.status == RunStatus::equilibrium);
        const double of_cell = 1e-3;  // what phases leave of a fall of two cells
        CHECK_THAT(scenes::probe(s, "bottom", "u.y") + std::stod(gap), WithinAbs(0, of_cell * cell));
        CHECK_THAT(scenes::probe(s, "top", "u.y") + std::stod(gap), WithinAbs(top, of_cell * cell));
      }
    }
  }
}

TEST_CASE("in a single phase a body that does not lie on a wall is refused, with its distance") {
  for (const char* basis : {"linear", "quadratic", "cubic"}) {
    for (const auto& [gap, said] :
         {std::pair{"0.45", "0.45 m (0.9 of a cell)"}, std::pair{"0.5", "0.5 m (1 of a cell)"},
          std::pair{"1e-5", "1e-05 m (2e-05 of a cell)"}}) {
      CAPTURE(basis, gap);
      CHECK_THROWS_WITH(run(block({std::string("constants.gap=") + gap, std::string("grid.basis=") + basis})),
                        Contains("wall[0].face") && Contains(said));
    }
  }
  CHECK(run(block({"constants.gap=1e-9"})).status == RunStatus::equilibrium);  // what rounding leaves
}

TEST_CASE("a support on a face holds nothing across a gap, which is refused with its size") {
  for (const char* basis : {"linear", "quadratic", "cubic"}) {
    for (const char* gap : {"0.01", "0.2", "0.45"}) {
      CAPTURE(basis, gap);
      CHECK_THROWS_WITH(run(block({"wall=[]", "support=[{face='bottom'}]", std::string("constants.gap=") + gap,
                                   std::string("grid.basis=") + basis})),
                        Contains("support[0].face") && Contains(std::string(gap) + " m"));
    }
  }
  CHECK(run(block({"wall=[]", "support=[{face='bottom'}]"})).status == RunStatus::equilibrium);
}
