// Runs that once ended in an equilibrium that was none, without a word.
#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Contains;

namespace {

constexpr double u12 = 0.001 * 115 / 12;  // of the bar's last point under its force, P0 x/(E A)

}  // namespace

TEST_CASE("equilibrium is that of the last change of the loads, not of a plateau that looks like the end") {
  const Summary s = run(scenes::bar({"force[0].value=P0*(1 + 0.3*(t > 300)*(t < 340.5))", "stop.time=1000",
                                     "stop.residual=1e-6", "damping.c=critical"}));
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.t >= 340.5);
  CHECK(scenes::probe(s, "p12", "u") == Approx(u12).epsilon(1e-5));
}

TEST_CASE("without an end of the run as well equilibrium is that of the last change of loads and supports") {
  const Summary load =
      run(scenes::bar({"force[0].value=P0*(0.5 + 0.5*(t > 500))", "stop.residual=1e-6", "damping.c=critical"}));
  CHECK(load.status == RunStatus::equilibrium);
  CHECK(load.t >= 500);
  CHECK(scenes::probe(load, "p12", "u") == Approx(u12).epsilon(1e-5));
  const Summary support = run(scenes::bar(
      {"support[0].u=0.001*min(t/700, 1)", "force=[]", "stop.residual=1e-6", "damping.c=critical", "exact={}"}));
  CHECK(support.status == RunStatus::equilibrium);
  CHECK(support.t >= 700);
  CHECK(scenes::probe(support, "p12", "u") == Approx(0.001).epsilon(1e-5));
}

TEST_CASE("a load that depends on the position is looked at where there are points") {
  const Summary s = run(scenes::bar({"force=[]", "body_force.value=[\"1e-4*(1 - 0.5*(x > 8)*(t > 300)*(t < 350))\"]",
                                     "stop.time=1000", "stop.residual=1e-6", "damping.c=critical", "exact={}"}));
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.t >= 350);
}

TEST_CASE("a load that comes and goes on few of the points is seen") {
  const Summary s = run(
      scenes::load("footing", {"stop.time=20", "body_force.value=[\"0\", \"-g*(y > 4)*(1 + 0.3*(t > 4)*(t < 8))\"]"}));
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.t >= 8);
  CHECK(scenes::probe(s, "block", "u.y") < -0.0145);  // 12.4 mm before the load grows for a while
}

TEST_CASE("a load that is no number later in the run is refused before it begins, with the key and the time") {
  CHECK_THROWS_WITH(run(scenes::bar({"force[0].value=P0*sqrt(400 - t)/20", "stop.time=1000"})),
                    Contains("force[0].value") && Contains("not a number at t = 400.0"));
  CHECK_THROWS_WITH(run(scenes::bar({"force=[]", "body_force.value=[\"1e-4/(t - 500)\"]", "stop.time=1000"})),
                    Contains("body_force.value") && Contains("infinite at t = 500"));
}

TEST_CASE("a damping of any size leaves leapfrog the step of the highest frequency, 2/omega_max") {
  for (const char* c : {"0.01", "1e2", "1e4", "1e6", "1e8"}) {
    CAPTURE(c);
    const Model model =
        make_model(scenes::load("block_on_wall", {std::string("damping.c=") + c, "integrator.step_fraction=1"}));
    REQUIRE(model.critical_step);
    CHECK(*model.critical_step * model.omega_max == Approx(2).epsilon(1e-3));
  }
  // With the damping taken exactly the limit, 2 c/omega_max², lies beyond any step that makes sense: one is taken.
  const Model exact =
      make_model(scenes::load("block_on_wall", {"damping.c=1e6", "integrator.method=symplectic-euler"}));
  REQUIRE(exact.critical_step);
  CHECK(*exact.critical_step * exact.omega_max <= 1e3 * (1 + 1e-12));
  CHECK_THROWS_WITH(run(scenes::load("block_on_wall", {"damping.c=1e6", "integrator.step=0.01"})),
                    Contains("is past the critical one"));
}

TEST_CASE("points on grid lines, whose gradients alone reach the nodes across, hold nothing still") {
  const stillpoint::test::TemporaryFolder folder;
  const std::string points = folder.write("points.csv", "x,volume\n1,1\n2,1\n3,1\n").string();
  // Three points on the lines of a grid, with nothing that holds them.
  const Scene scene = load_scene(folder.write("scene.toml", R"(dim = 1
grid = {min = [0], max = [6], cells = [6], basis = "linear"}
body = {file = ")" + points + R"(", material = "rubber"}
material.rubber = {law = "linear-elastic", E = 1, nu = 0, rho = 1}
mass.kind = "lumped"
body_force.value = [0.01]
damping.strategy = "none"
stop = {time = 5, residual = 0}
)"));
  Simulation simulation(scene);
  simulation.run();
  CHECK(simulation.status() == RunStatus::end_time);
  CHECK(simulation.t() == Approx(5));
  for (const double u : simulation.field("u")) CHECK(u == Approx(0.01 * 5 * 5 / 2).epsilon(1e-9));
}

TEST_CASE("a residual that is small beside the stiff part's forces alone is no equilibrium of the soft part") {
  // E = 1 on [0, 5] and 1e7 on [5, 10], pushed at 6 and pulled back at 9, and by 1e-6 at the end: that alone stretches
  // the soft part.
  const auto soft_and_stiff = [](const std::string& way, const std::vector<std::string>& more = {}) {
    const stillpoint::test::TemporaryFolder folder;
    std::vector<std::string> set = {way};
    set.insert(set.end(), more.begin(), more.end());
    return run(load_scene(folder.write("scene.toml", R"(dim = 1
grid = {min = [0], max = [10], cells = [20], basis = "linear"}
material.soft = {law = "linear-elastic", E = 1, nu = 0, rho = 1}
material.stiff = {law = "linear-elastic", E = 1e7, nu = 0, rho = 1e7}
mass.kind = "lumped"
stop.residual = 1e-6
[[body]]
min = [0]
max = [5]
material = "soft"
points_per_cell = 2
[[body]]
min = [5]
max = [10]
material = "stiff"
points_per_cell = 2
[[support]]
at = 0
[[force]]
at = [6]
value = [1]
[[force]]
at = [9]
value = [-1]
[[force]]
at = [10]
value = [1e-6]
[[probe]]
name = "end"
at = [10]
fields = ["u"]
)"),
                          set),
               {.threads = 1});
  };
  // 5 · 1e-6/1 − 3 · 1/1e7 + 5 · 1e-6/1e7
  constexpr double u_end = 5e-6 - 3e-7 + 5e-13;
  for (const std::string way : {"solve.method=cg", "solve.method=lbfgs", "damping.strategy=viscous",
                                "damping.strategy=kinetic", "damping.strategy=auto"}) {
    CAPTURE(way);
    const Summary s = soft_and_stiff(way);
    CAPTURE(s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    REQUIRE(s.distance);
    CHECK(*s.distance <= 1.1e-3);  // beside the last displacement, not the largest
    CHECK(scenes::probe(s, "end", "u") == Approx(u_end).epsilon(1.1e-3));
  }
  // Cundall's damping holds back every node by its own force, the soft part by that of the stiff one.
  CHECK(soft_and_stiff("damping.strategy=cundall", {"stop.steps=20000"}).status == RunStatus::step_limit);
  // Told not to look, cg takes the residual for an equilibrium.
  CHECK(*soft_and_stiff("solve.method=cg", {"stop.distance=0"}).distance > 1);
}
