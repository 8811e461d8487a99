// A viscoplastic body is at rest for good only where no point is stressed beyond its strength.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "says.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using scenes::with;
using stillpoint::test::says;

namespace {

// A block of clay, smooth at its left and its bottom, that bears 2 c = 20 kPa.
const std::string clay_block = R"(
dim = 2
[grid]
min = [0, 0]
max = [1, 1]
cells = [2, 2]
[body]
material = "clay"
state = "plane-strain"
points_per_cell = 4
[material.clay]
law = "drucker-prager"
E = 1e7
nu = 0.3
rho = 2000
c = 1e4
fluidity = 1e-7
[phase]
max_motion = "none"
[[support]]
face = "left"
kind = "roller"
[[support]]
face = "bottom"
kind = "roller"
[[traction]]
face = "top"
value = [0, -4e4]
[stop]
residual = 1e-6
steps = 40000
[[probe]]
name = "m"
at = [0.5, 0.5]
fields = ["stress.yy", "u.y", "plastic_strain"]
)";

// Loaded on a third of its width by 60 % more than a point bears, and by less than the block does.
const std::vector<std::string> in_part = {"grid.max=[3,1]", "grid.cells=[6,2]",
                                          "traction=[{line=[[0,1],[1,1]], value=[0,-2.6e4]}]", "probe[0].at=[0.5,0.9]"};

Summary end_of_clay(const std::vector<std::string>& set) {
  return run(load_scene("block.toml", clay_block, set), {.threads = 1});
}
double settlement_of_block(const Summary& s) { return scenes::probe(s, "m", "u.y"); }

}  // namespace

TEST_CASE("no static solver finds an equilibrium of viscoplastic material beyond its strength, whatever its fluidity") {
  for (const char* method : {"newton", "newton-cg", "cg", "lbfgs"}) {
    for (const char* fluidity : {"1e-12", "1e-7", "1"}) {
      for (const char* load : {"-6e4", "-8e4"}) {  // less of it a block bears that spreads
        CAPTURE(method, fluidity, load);
        const Summary s =
            end_of_clay({fmt::format("solve.method={}", method), fmt::format("traction[0].value=[0,{}]", load),
                         fmt::format("material.clay.fluidity={}", fluidity), "stop.steps=2000"});
        CAPTURE(s.reason);
        CHECK(s.exit_status >= 3);
        CHECK(says(s, "material.clay.fluidity has no part in a static solution"));
      }
    }
  }
}

TEST_CASE("below the limit a static solver's answer is that of the rate-independent law, bit for bit, and it says so") {
  for (const char* method : {"newton", "newton-cg", "cg", "lbfgs"}) {
    CAPTURE(method);
    const auto of_fluidity = [&](const char* fluidity) {
      return end_of_clay(with(in_part, {fmt::format("solve.method={}", method), "solve.load_steps=4",
                                        fmt::format("material.clay.fluidity={}", fluidity)}));
    };
    const Summary viscous = of_fluidity("1e-7"), plastic = of_fluidity("0");
    CAPTURE(viscous.reason);
    CHECK(viscous.status == RunStatus::equilibrium);
    CHECK(scenes::probe(viscous, "m", "plastic_strain") > 1e-5);
    CHECK(settlement_of_block(viscous) == settlement_of_block(plastic));
    CHECK(says(viscous, "has no part in a static solution"));
    CHECK_FALSE(says(plastic, "has no part in a static solution"));
  }
}

TEST_CASE("a relaxation that creeps beyond its strength is at no equilibrium, and says where and by how much") {
  for (const std::vector<std::string>& set :
       {std::vector<std::string>{"damping.strategy=auto", "material.clay.fluidity=1e-12"},
        {"damping.strategy=viscous", "material.clay.fluidity=1e-13"},
        {"damping.strategy=kinetic", "material.clay.fluidity=1e-12", "grid.basis=quadratic"},
        {"damping.strategy=cundall", "material.clay.fluidity=1e-12", "phase.max_motion=0.1"},
        {"damping.strategy=auto", "material.clay.fluidity=1e-12", "traction[0].value=[0,-2.1e4]"}}) {
    CAPTURE(set);
    const Summary s = end_of_clay(set);
    CAPTURE(s.reason);
    CHECK(s.status == RunStatus::step_limit);
    CHECK(s.exit_status == 3);
    CHECK(s.reason.find("it creeps: at material point ") != std::string::npos);
    CHECK(s.reason.find("material.clay.fluidity") != std::string::npos);
    CHECK(says(s, "time constant"));
  }
  // Elastic: σ_yy = −40 kPa and σ_zz = −12 kPa, √J₂ = 20.5 kPa of c = 10 kPa.
  const Summary s = end_of_clay({"damping.strategy=auto", "material.clay.fluidity=1e-12"});
  CAPTURE(s.reason);
  CHECK(s.reason.find("the yield function is 1.05 of the strength") != std::string::npos);
}

TEST_CASE(
    "below the limit a relaxation comes to the rate-independent equilibrium as soon as its over-stress has gone") {
  const double plastic =
      settlement_of_block(end_of_clay(with(in_part, {"solve.method=newton", "solve.load_steps=16"})));
  const std::vector<std::string> slowly =
      with(in_part,
           {"traction=[{line=[[0,1],[1,1]], value=[0,'-2.6e4*min(t/5,1)']}]", "stop.time=2000", "stop.steps=4000000"});
  double last = 0;
  for (const char* fluidity : {"1e-5", "1e-6", "1e-7"}) {
    const Summary s =
        end_of_clay(with(slowly, {fmt::format("material.clay.fluidity={}", fluidity), "damping.strategy=viscous"}));
    CAPTURE(fluidity, s.reason, s.t);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(settlement_of_block(s) == Approx(plastic).epsilon(0.02));
    CHECK(s.t > last);  // the slower, the later
    last = s.t;
  }
}
