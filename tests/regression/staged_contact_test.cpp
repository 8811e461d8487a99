// Stages with contact: rigid bodies and bodies that touch appear and go, and what they touch does.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "linalg/multigrid.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using scenes::with;

namespace {

// The column of ladder/lifts: a strip of this width between smooth walls, whose ground is placed before its fill.
namespace fill {
constexpr double M = 10e6, weight = 18e3, half = 3, H = 2 * half, width = 1;  // [Pa], [N/m³], [m]
/// How far the top of the fill comes down under both weights since it was placed: on the ground, and by itself.
constexpr double settled = weight / M * (half * half + half * half / 2);
}  // namespace fill

const std::vector<std::string> in_motion = {"solve.method=relaxation", "damping.strategy=viscous",
                                            "stop.residual=1e-9"};

Summary staged_column(const std::string& stages, const std::vector<std::string>& more) {
  return run(scenes::load(
                 "ladder/lifts",
                 with({"body=[{name='ground', max=['h', 'H/2'], material='fill', state='plane-strain'}, "
                       "{name='fill', min=[0, 'H/2'], max=['h', 'H'], material='fill'}]",
                       "stage=[" + stages + "]", "probe=[{name='top', at=['h/2', 'H'], fields=['u.y', 'stress.yy']}]"},
                      more)),
             {.threads = 1});
}

double force_of(const Summary& s, const std::string& name) { return s.contacts.at(name + ".force_y"); }

constexpr const char* plate =
    "rigid=[{name='plate', half_plane=[[0, 'H'], [0, -1]], motion=['0', '-0.05*min(max(t - 2, 0), 1)']}]";
constexpr double pressed_by = 0.05;  // [m]

std::string footing(double load) {
  return fmt::format("rigid=[{{name='footing', min=[0, 'H'], max=['h', 'H + 1'], free=true, force=['0', '{}']}}]",
                     -load);
}

}  // namespace

TEST_CASE("a plate presses fill that was placed later with its modulus times the strain, beyond what has settled") {
  for (const auto& way : {std::vector<std::string>{}, in_motion}) {
    CAPTURE(way.size());
    const Summary s = staged_column("{at=1, add=['fill']}, {at=2, add=['plate']}, {at=3}",
                                    with({plate, "stop.time=20", "stop.residual=1e-9"}, way));
    CAPTURE(s.reason);
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK(force_of(s, "plate") ==
          Approx(-fill::M * (pressed_by - fill::settled) / fill::H * fill::width).epsilon(1e-6));
  }
}

TEST_CASE("a rigid body there from the start presses a body that comes later, which alone it names") {
  const Summary s =
      staged_column("{at=1, add=['fill']}, {at=4}",
                    {"rigid=[{name='plate', half_plane=[[0, 'H'], [0, -1]], motion=['0', '-0.05*min(t/4, 1)'], "
                     "bodies=['fill']}]",
                     "stop.time=20", "body_force.value=[0, 0]"});
  REQUIRE(s.status == RunStatus::equilibrium);
  CHECK(force_of(s, "plate") == Approx(-fill::M * pressed_by / fill::H * fill::width).epsilon(1e-6));
}

TEST_CASE("a free footing that is put on fill bears its load, and goes down with what it stands on") {
  constexpr double load = 40e3;
  for (const auto& way : {std::vector<std::string>{}, in_motion}) {
    CAPTURE(way.size());
    const Summary s = staged_column("{at=1, add=['fill'], equilibrium=true}, {at=2, add=['footing'], equilibrium=true}",
                                    with({footing(load)}, way));
    CAPTURE(s.reason);
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK(force_of(s, "footing") == Approx(-load).epsilon(1e-6));
    CHECK(s.contacts.at("footing.displacement_y") ==
          Approx(-fill::settled - load / fill::width * fill::H / fill::M).epsilon(1e-5));
  }
}

TEST_CASE("what a rigid body bore goes with it, and fill that is dug away below a fixed one leaves no force") {
  const Summary gone =
      staged_column("{at=1, add=['fill']}, {at=2, add=['plate']}, {at=3, remove=['plate']}", {plate, "stop.time=20"});
  REQUIRE(gone.status == RunStatus::equilibrium);
  CHECK(force_of(gone, "plate") == 0);
  CHECK(scenes::probe(gone, "top", "u.y") == Approx(-fill::settled).epsilon(1e-6));
  const Summary dug =
      staged_column("{at=1, add=['fill']}, {at=2, add=['plate']}, {at=3, remove=['fill']}",
                    {plate, "stop.time=20", "probe=[{name='ground', at=['h/2', 'H/2'], fields=['u.y']}]"});
  REQUIRE(dug.status == RunStatus::equilibrium);
  CHECK(force_of(dug, "plate") == 0);
  CHECK(scenes::probe(dug, "ground", "u.y") ==
        Approx(-fill::weight / fill::M * fill::half * fill::half / 2).epsilon(1e-6));
}

TEST_CASE("a block that is put on another one by a contact weighs on it, and no more once it is gone") {
  const std::vector<std::string> touching = {"contact=[{bodies=['fill', 'ground']}]",
                                             "probe=[{name='ground', at=['h/2', 'H/4'], fields=['u.y']}]"};
  constexpr double y = fill::half / 2, alone = fill::weight / fill::M * (fill::half * y - y * y / 2),
                   below = alone + fill::weight * fill::half / fill::M * y;
  const auto load = with(touching, with(in_motion, {"damping.c=20"}));
  const Summary put = staged_column("{at=1, add=['fill'], ramp=0.2}", load);
  CAPTURE(put.reason);
  REQUIRE(put.status == RunStatus::equilibrium);
  CHECK(force_of(put, "fill+ground") == Approx(fill::weight * fill::half * fill::width).epsilon(1e-5));
  CHECK(scenes::probe(put, "ground", "u.y") == Approx(-below).epsilon(1e-5));
  const Summary dug =
      staged_column("{at=1, add=['fill'], ramp=0.2, equilibrium=true}, {at=2, remove=['fill'], ramp=0.2}", load);
  REQUIRE(dug.status == RunStatus::equilibrium);
  CHECK(force_of(dug, "fill+ground") == 0);
  CHECK(scenes::probe(dug, "ground", "u.y") == Approx(-alone).epsilon(1e-6));
}

TEST_CASE("a stage that changes nothing changes nothing of a contact with friction, whether it sticks or slips") {
  const auto pushed = [](const std::string& law, double friction, const std::string& stages) {
    return run(scenes::load(
        "ladder/lifts",
        with(in_motion, {"body=[{name='ground', max=['h', '2*h'], material='fill', "
                         "state='plane-strain'}]",
                         "rigid=[{name='plate', half_plane=[[0, '2*h'], [0, -1]], motion=['0.01*min(max(t "
                         "- 1, 0), 1)', '-0.02*min(t, 1)']}]",
                         fmt::format("rigid[0].friction={}", friction), "support=[{face='bottom'}]", "probe=[]",
                         "damping.strategy=cundall", "material.fill.law=" + law, "stage=[" + stages + "]",
                         "stop.time=8", "grid.min=['-h', 0]", "grid.max=['2*h', '3*h']", "grid.cells=[12, 12]",
                         "body_force.value=[0, 0]", "stop.residual=1e-6"})));
  };
  for (const std::string law : {"linear-elastic", "hencky"}) {
    for (const double friction : {0.05, 0.9}) {
      CAPTURE(law, friction);
      const Summary without = pushed(law, friction, ""), staged = pushed(law, friction, "{at=1.5, ramp=0.2}");
      REQUIRE(without.status == RunStatus::equilibrium);
      REQUIRE(staged.status == RunStatus::equilibrium);
      const double normal = force_of(without, "plate"), shear = without.contacts.at("plate.force_x");
      CHECK(normal < -0.9e5);
      CHECK(shear > 1e3);
      CHECK(std::abs(force_of(staged, "plate") - normal) < 3e-3 * std::abs(normal));
      CHECK(std::abs(staged.contacts.at("plate.force_x") - shear) < 3e-3 * std::abs(normal));
    }
  }
}

TEST_CASE("stages with contact have the same bits for any number of threads") {
  const auto figures = [](int threads) {
    const Summary s = run(scenes::load("ladder/lifts", with({plate,
                                                             "stage=[{at=0.5, add=['lift 2', 'lift 3', 'lift 4', "
                                                             "'lift 5', 'lift 6'], ramp=0.1}, {at=2, "
                                                             "add=['plate'], ramp=0.1}, {at=2.6, remove=['lift 6']}]",
                                                             "rigid[0].friction=0.3", "stop.time=3",
                                                             "material.fill.law=drucker-prager", "material.fill.c=1e5"},
                                                            in_motion)),
                          {.threads = threads});
    return fmt::format("{} {:a} {:a} {:a}", s.steps, s.residual, force_of(s, "plate"),
                       scenes::probe(s, "lift 5", "u.y"));
  };
  CHECK(figures(1) == figures(2));
  CHECK(figures(1) == figures(3));
}

TEST_CASE("a load that a displacement drives begins with its stage and counts from there, or goes on through stages") {
  const auto driven = [](const std::string& stages, const std::string& begin, const std::string& weight_of_all) {
    const Summary s = run(scenes::load(
        "ladder/lifts",
        with(in_motion,
             {"body=[{name='ground', max=['h', 'H'], material='fill', state='plane-strain'}]", "stage=[" + stages + "]",
              "probe=[]", "body_force.value=[0, " + weight_of_all + "]",
              "traction=[{line=[[0, 'H'], ['h', 'H']], value=[0, -1e3]}]",
              "load={displacement='0.03*min(max(t - 2, 0), 1)', of=['traction[0]']" + begin + "}", "stop.time=30"})));
    CAPTURE(s.reason);
    REQUIRE(s.load);
    CHECK(s.load->displacement > 0.025);  // it lags behind what is prescribed
    CHECK(s.load->factor * 1e3 == Approx(fill::M * s.load->displacement / fill::H).epsilon(1e-6));
  };
  driven("{at=1, equilibrium=true}, {at=2, ramp=0}", ", at=2", "-10");
  driven("{at=2.5, ramp=0.1}, {at=4, ramp=0.1}", "", "0");
}

TEST_CASE("an embankment in lifts settles as the closed solution says with a multigrid mass") {
  if (!multigrid_is_missing().empty()) return;
  const Summary s = run(scenes::load(
      "ladder/lifts", {"mass.kind=multigrid", "solve.method=relaxation", "stop.residual=1e-8", "damping.strategy=auto",
                       "stage=[{at=0, equilibrium=true}, {at=1, add=['lift 2'], ramp=0, equilibrium=true}, {at=2, "
                       "add=['lift 3', 'lift 4', 'lift 5', 'lift 6'], ramp=0, equilibrium=true}]"}));
  CAPTURE(s.reason);
  REQUIRE(s.status == RunStatus::equilibrium);
  // The last lifts were placed together, four on two.
  CHECK(scenes::probe(s, "lift 6", "u.y") == Approx(-1.8e-3 * (4 * 2 + 4 * 4 / 2)).epsilon(1e-4));
}

TEST_CASE("a block from which a stage takes a plate comes to rest, though some functions reach next to none of it") {
  // The plate has pushed the block out sideways by a millionth of a cell.
  const Summary s = scenes::run_text(R"toml(
dim = 2
[grid]
min = [-0.3, 0]
max = [1.3, 1.6]
cells = [16, 16]
[body]
min = [0, 0]
max = [1, 0.93]
material = "m"
[material.m]
law = "hencky"
E = 100
nu = 0
rho = 1
[[support]]
face = "bottom"
[[rigid]]
name = "plate"
min = [-0.2, 0.95]
max = [1.2, 1.2]
free = true
force = ["0", "-1"]
friction = 0.3
[[stage]]
at = 0
equilibrium = true
[[stage]]
at = 3
remove = ["plate"]
equilibrium = true
[phase]
max_motion = 0.1
[damping]
strategy = "auto"
[stop]
residual = 1e-8
steps = 20000
)toml");
  CAPTURE(s.reason);
  REQUIRE(s.status == RunStatus::equilibrium);
  REQUIRE(s.omega_1);
  const double of_column = std::numbers::pi / 2 * std::sqrt(100.0) / 0.93;  // in bending it is a little slower
  CHECK(*s.omega_1 < of_column);
  CHECK(*s.omega_1 > of_column / 4);
}
