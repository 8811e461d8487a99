// An equilibrium that the least disturbance ends is none to be reported as such.
#include "simulation/watch/equilibrium_stability.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include <fmt/format.h>

#include "files.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "statics.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Contains;
using stillpoint::test::TemporaryFolder;
using Kind = EquilibriumStability::Kind;

namespace {

// The cantilever of problems/cantilever.toml pushed along its axis by a share of Euler's load, π²/4 E I/L².
Scene pushed_column(double share, const std::string& method, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {
      fmt::format("constants.load={}", share * std::numbers::pi * std::numbers::pi / 4),
      "traction=[{face='right', value=['-P/h', 0.0]}]", "grid.cells=[20, 1]", method};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return scenes::load("cantilever", overrides);
}

const std::vector<std::string> ways_to_equilibrium = {
    "solve.method=newton",      "solve.method=newton-cg",   "solve.method=cg",          "solve.method=lbfgs",
    "damping.strategy=viscous", "damping.strategy=kinetic", "damping.strategy=cundall", "damping.strategy=auto"};

// A Hencky bar, σ = E ln λ on its deformed section: P = E ln λ/λ, P' = E (1 − ln λ)/λ², < 0 for λ > e.
Scene hencky_bar(const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"material.bar={law='hencky', E=1, nu=0, rho=1}", "grid.basis=linear",
                                        "mass.kind=lumped", "exact={}", "damping.c=1"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return scenes::bar(overrides);
}

// u = (λ − 1) x at the nodes, and what holds its end left free.
EquilibriumStability stretched(double stretch, double& omega_max) {
  const Scene scene = hencky_bar({});
  const auto phase = make_phase(scene);
  std::vector<double> u(phase->size());
  for (std::size_t i = 0; i < u.size(); ++i)  // free nodes from the second on, evenly spaced
    u[i] = (stretch - 1) * 10.0 * static_cast<double>(i + 1) / static_cast<double>(u.size());
  omega_max = make_model(scene).omega_max;
  return stability_of(*phase, 0, u, 1e-9);
}

}  // namespace

TEST_CASE("a column below Euler's load is in stable equilibrium, by any way to it") {
  for (const std::string& way : ways_to_equilibrium) {
    CAPTURE(way);
    const Summary s = run(pushed_column(0.95, way));
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.exit_status == 0);
    CHECK(s.stability == "stable");
    CHECK_FALSE(s.unstable_omega_squared);
  }
}

TEST_CASE("a straight column beyond Euler's load is named unstable, with status 3, by any way that does not bend it") {
  for (const double share : {1.05, 3.2}) {
    for (const std::string& way : ways_to_equilibrium) {
      CAPTURE(share, way);
      const Summary s = run(pushed_column(share, way));
      CAPTURE(s.reason);
      if (s.status == RunStatus::equilibrium) {  // on a long way rounding has grown until it buckled: that stands
        CHECK(share > 3);
        CHECK(s.stability == "stable");
        CHECK(std::abs(scenes::probe(s, "end", "u.y")) == Approx(6.85).epsilon(0.01));
        continue;
      }
      CHECK(to_string(s.status) == "unstable-equilibrium");
      CHECK(s.exit_status == 3);
      CHECK(s.stability == "unstable");
      CHECK_THAT(s.reason, Contains("omega^2 = -") && Contains("initial.u"));
      REQUIRE(s.unstable_omega_squared);
      CHECK(*s.unstable_omega_squared < 0);
      // Near Euler's load the mode is that of the unloaded beam: ω² = ω₁² (1 − P/P_E), shear apart.
      if (share == 1.05) CHECK(*s.unstable_omega_squared == Approx(-0.05 * *s.omega_1 * *s.omega_1).epsilon(0.2));
    }
  }
}

TEST_CASE("the buckled shape that a lateral force leads to is stable") {
  const Summary s =
      run(pushed_column(1.5, "solve.method=newton", {"traction=[{face='right', value=['-P/h', '0.01*P/h']}]"}));
  CAPTURE(s.reason);
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.stability == "stable");
  CHECK(std::abs(scenes::probe(s, "end", "u.y")) > 5);
}

TEST_CASE("a column under a load that turns with it stays stable far beyond Euler's, up to Beck's 20.05 E I/L²") {
  // The load's tangent is unsymmetric: its symmetric part alone has a negative eigenvalue long before.
  for (const double load : {2.6, 7.9, 19.0}) {
    const Summary s =
        run(pushed_column(1, "solve.method=newton",
                          {fmt::format("constants.load={}", load), "traction=[{face='right', pressure='P/h'}]"}));
    CAPTURE(load, s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.stability == "stable");
  }
  const Summary beyond = run(
      pushed_column(1, "solve.method=newton", {"constants.load=21.5", "traction=[{face='right', pressure='P/h'}]"}));
  CHECK(beyond.stability != "stable");  // it flutters: the lowest eigenvalues are a complex pair
}

TEST_CASE("an unstable equilibrium is found where the loads' tangent is unsymmetric as well") {
  const auto pushed = [](double share) {
    return run(pushed_column(
        share, "solve.method=newton",
        {"traction=[{face='right', value=['-P/h', 0.0]}, {face='top', pressure='0.3*P/h'}, {face='bottom', "
         "pressure='0.3*P/h'}]"}));
  };
  CHECK(pushed(0.9).stability == "stable");
  const Summary s = pushed(1.2);
  CHECK(s.status == RunStatus::unstable_equilibrium);
  CHECK_THAT(s.reason, Contains("omega^2 = -"));
}

TEST_CASE("the mode of an unstable equilibrium is written with the points' positions, and gone after a stable run") {
  const TemporaryFolder folder;
  const Summary s = run(pushed_column(3.2, "solve.method=newton"), {.out = folder.path()});
  const auto file = folder.path() / "unstable_mode.csv";
  REQUIRE(std::filesystem::exists(file));
  std::istringstream rows(test::contents(file));
  std::string line;
  std::getline(rows, line);
  CHECK(line == "point,x,y,mode.x,mode.y");
  std::size_t count = 0;
  double longest = 0, at = 0;
  while (std::getline(rows, line)) {
    ++count;
    std::ranges::replace(line, ',', ' ');
    std::istringstream row(line);
    double point = 0, x = 0, y = 0, mode_x = 0, mode_y = 0;
    REQUIRE(row >> point >> x >> y >> mode_x >> mode_y);
    CHECK(std::abs(mode_y) <= 1);
    if (std::abs(mode_y) > longest) longest = std::abs(mode_y), at = x;
  }
  CHECK(count == s.points);
  CHECK(longest == Approx(1).epsilon(0.01));
  CHECK(at > 9.5);
  run(pushed_column(0.5, "solve.method=newton"), {.out = folder.path()});
  CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("a Hencky bar is stable up to the stretch e, at which its force is largest, and unstable beyond") {
  double omega_max = 0;
  for (const double stretch : {1.5, 2.6, 2.71}) CHECK(stretched(stretch, omega_max).kind == Kind::stable);
  for (const double stretch : {2.73, 3.0, 4.0}) {
    const EquilibriumStability found = stretched(stretch, omega_max);
    CAPTURE(stretch);
    REQUIRE(found.kind == Kind::unstable);
    // K = P'/E K(0), whose lowest eigenvalue is that of the highest mode.
    const double softened = (1 - std::log(stretch)) / (stretch * stretch);
    CHECK(found.omega_squared == Approx(softened * omega_max * omega_max).epsilon(1e-4));
  }
}

TEST_CASE("a finite-strain body that nothing holds is neutral, not unstable, and its run says so") {
  const Summary s = run(hencky_bar({"support=[]", "force=[]", "body_force.value=0.0"}));
  CAPTURE(s.reason, s.stability);
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.stability == "neutral");
  REQUIRE_FALSE(s.notes.empty());
  CHECK_THAT(s.notes.back(), Contains("neutral") && Contains("nothing holds the body"));
}

namespace {

/// A block, as high as it says and 1 wide, on top of a rough drum.
Summary block_on_drum(double height, double radius, const std::string& law, const std::string& friction) {
  const std::string text = fmt::format(R"(
dim = 2
grid = {{min = [0, 0], max = [4, 4], cells = [32, 32]}}
body = {{name = "block", min = [1.5, 1.0], max = [2.5, {}], material = "m", placement = "gauss"}}
material.m = {{law = "{}", E = 1e6, nu = 0.3, rho = 1000}}
rigid = [{{name = "drum", disc = [2.0, {}], radius = {}, friction = {}}}]
body_force = {{value = [0, -10]}}
damping = {{strategy = "auto"}}
)",
                                       1 + height, law, 1 - radius, radius, friction);
  return run(load_scene("drum.toml", text, {}), {.threads = 1});
}
bool says_unjudged(const Summary& s) {
  return std::ranges::any_of(
      s.notes, [](const std::string& note) { return note.find("whether it would roll or tip") != std::string::npos; });
}

}  // namespace

TEST_CASE("a block on top of a rough drum rolls off it if the drum's radius is less than half its height") {
  for (const char* friction : {"'rough'", "0.5"}) {
    CAPTURE(friction);
    const Summary high = block_on_drum(2, 0.4, "neo-hookean", friction);
    CAPTURE(high.reason, high.notes);
    CHECK(high.status == RunStatus::unstable_equilibrium);
    const Summary low = block_on_drum(0.5, 0.8, "neo-hookean", friction);
    CAPTURE(low.reason, low.notes);
    CHECK(low.status == RunStatus::equilibrium);
    CHECK(low.stability == "stable");
  }
}

TEST_CASE("a block on top of a rough drum of a law that does not feel its tipping says that it was not judged") {
  const Summary s = block_on_drum(2, 0.4, "linear-elastic", "'rough'");
  CHECK(s.stability.empty());
  CHECK(says_unjudged(s));
}

TEST_CASE("no stability is looked for where K cannot have changed, or where points remember") {
  CHECK(run(scenes::load("block_on_wall")).stability.empty());
  const Scene linear = scenes::bar();
  const auto phase = make_phase(linear);
  CHECK(stability_of(*phase, 0, std::vector<double>(phase->size(), 0.0), 0).kind == Kind::not_tested);
  const auto plastic = make_phase(scenes::load("footing"));
  CHECK(stability_of(*plastic, 0, std::vector<double>(plastic->size(), 0.0), 0).kind == Kind::not_tested);
}
