// Contact with rigid bodies against exact answers, and what has to be the same whichever way it is found.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace stillpoint::test {
namespace {

constexpr double block_stiffness = 1e6 * 0.7 / (1.3 * 0.4);  // λ + 2μ of the block

using scenes::run_ladder;

/// Clay around a rigid bar of radius 1/2: half of it, above its plane of symmetry, under a pressure of 20 c that a
/// plate keeps. Its hole is a polygon of many sides, each a fifth of a cell long.
std::string around_a_bar(const std::string& motion, const std::string& phase, double strength) {
  const double pi = std::acos(-1.0);
  constexpr int sides = 64;
  std::string hole;
  for (int i = 0; i <= sides; ++i) {
    const double angle = pi * (1 - static_cast<double>(i) / sides);
    hole += fmt::format(", [{:.10f}, {:.10f}]", 0.5 * std::cos(angle), std::abs(0.5 * std::sin(angle)));
  }
  return fmt::format(
      "dim = 2\n[grid]\nmin = [-2, 0]\nmax = [2, 2.25]\ncells = [32, 18]\nbasis = 'quadratic'\n"
      "[body]\nmaterial = 'clay'\npoints_per_cell = 9\npolygon = [[2, 0], [2, 2], [-2, 2], [-2, 0]{}]\n"
      "[material.clay]\nlaw = 'drucker-prager'\nE = 1000\nnu = 0.48\nrho = 1\nphi = 0\npsi = 0\nc = {}\n"
      "cone = 'plane-strain'\n[phase]\n{}\ndilatation = 'cells'\n"
      "[[support]]\nface = 'bottom'\nkind = 'roller'\n[[support]]\nface = 'left'\nkind = 'roller'\n"
      "[[support]]\nface = 'right'\nkind = 'roller'\n"
      "[[rigid]]\nname = 'plate'\nhalf_plane = [[0, 2], [0, -1]]\nfree = true\nforce = ['0', '-80*min(t,1)']\n"
      "[[rigid]]\nname = 'bar'\ndisc = [0, 0]\nradius = 0.5\nmotion = ['{}', '0']\n",
      hole, strength, phase, motion);
}

/// The force of the plate beside the exact one.
double error_of_plate(const Summary& s) {
  return std::abs(s.contacts.at("plate.force_y") / (-block_stiffness * 0.01 / 1.03 * 0.55) - 1);
}

}  // namespace

TEST_CASE("a plate presses a block, whose top lies off the grid, with the exact force by every way to rest") {
  for (const char* strategy : {"viscous", "adaptive", "kinetic", "fire", "nesterov", "one-sided", "cundall", "auto"}) {
    CAPTURE(strategy);
    const Summary s = run_ladder("pressed_plate", {std::string("damping.strategy=") + strategy});
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK(error_of_plate(s) < 1e-5);  // a hundred times the residual of 1e-8, and what a last update would change
    CHECK(s.contacts.at("plate.contact_area") == Approx(0.55));
    CHECK(s.contacts.at("plate.moment_z") == Approx(s.contacts.at("plate.force_y") * 0.275).epsilon(1e-6));
    CHECK(s.reactions.at("floor")[1] == Approx(-s.contacts.at("plate.force_y")).epsilon(1e-6));
  }
  for (const char* method : {"newton", "newton-cg", "cg", "lbfgs"}) {
    CAPTURE(method);
    const Summary s = run_ladder("pressed_plate", {std::string("solve.method=") + method});
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK(error_of_plate(s) < 1e-5);
  }
}

TEST_CASE("two updates of the multipliers find the force of a plate to a thousandth on eight cells") {
  const Summary s = run_ladder("pressed_plate", {"stop.residual=1e-4", "damping.strategy=viscous"});
  REQUIRE(s.status == RunStatus::equilibrium);
  CHECK(error_of_plate(s) < 1e-3);
}

TEST_CASE("a block slides down an incline at the speed that Coulomb's friction leaves it, and stays if it holds") {
  const double theta = 0.3, down = std::sin(theta), c = 20, m = 500;
  for (const double share : {0.0, 0.5, 0.9, 1 / 1.001, 1 / 0.999}) {
    const double mu = share * std::tan(theta);
    CAPTURE(share);
    const Summary s = run_ladder("incline", {fmt::format("rigid[0].friction={:.17g}", mu)});
    const double speed = -(scenes::probe(s, "block", "momentum.x") * std::cos(theta) +
                           scenes::probe(s, "block", "momentum.y") * std::sin(theta)) /
                         m;
    const double expected = std::max(0.0, 10 * (down - mu * std::cos(theta)) / c);
    CHECK(std::abs(speed - expected) < 1e-3 * expected + 1e-6);
    const double x = s.contacts.at("slope.force_x"), y = s.contacts.at("slope.force_y");
    const double normal = -x * std::sin(theta) + y * std::cos(theta), shear = x * std::cos(theta) + y * std::sin(theta);
    CHECK(normal == Approx(m * 10 * std::cos(theta)).epsilon(1e-5));
    CHECK(shear == Approx(std::min(mu * normal, m * 10 * down)).epsilon(1e-5).margin(1e-6));
    if (share > 0) CHECK(s.contacts.at("slope.slipping") == (share < 1 ? 1.0 : 0.0));
  }
}

TEST_CASE("adhesion holds a block with its stress times the area that is pressed, beside friction") {
  const double theta = 0.3, c = 20, m = 500, weight = m * 10, area = 1;
  for (const double mu : {0.0, 0.5 * std::tan(theta)}) {
    const double left = weight * (std::sin(theta) - mu * std::cos(theta));  // to what friction bears
    for (const double share : {0.5, 1 / 1.001, 1 / 0.999}) {
      CAPTURE(mu, share);
      const Summary s = run_ladder("incline", {fmt::format("rigid[0].friction={:.17g}", mu),
                                               fmt::format("rigid[0].adhesion={:.17g}", share * left / area),
                                               "stop.time=8"});  // the shear evens out as what is at its limit slips
      const double speed = -(scenes::probe(s, "block", "momentum.x") * std::cos(theta) +
                             scenes::probe(s, "block", "momentum.y") * std::sin(theta)) /
                           m;
      const double expected = std::max(0.0, (1 - share) * left / m / c);
      CHECK(std::abs(speed - expected) < 1e-3 * expected + 1e-6);
      CHECK(s.contacts.at("slope.slipping") == (share < 1 ? 1.0 : 0.0));
    }
  }
}

TEST_CASE("clay that flows around a bar leaves no point behind in it") {
  const Summary s = run_ladder(
      "dragged_bar", {"grid.x=[[-4,4,48]]", "grid.y=[[0,3.25,20]]", "material.clay.E=300", "constants.v=0.1",
                      "body.points_per_cell=9", "phase.dilatation=cells", "damping.strategy=one-sided", "stop.time=16",
                      "rigid[0].force=['0','-8*q*s_u*min(t/2,1)']", "rigid[1].motion=['v*max(t-3,0)','0']"});
  REQUIRE(s.status == RunStatus::end_time);
  CHECK(s.contacts.at("bar.contact_area") > 1.5);  // it goes around
  for (const std::string& note : s.notes) CHECK_THAT(note, !Catch::Contains("has gone past the border"));
}

TEST_CASE("in space a block slides the way that its load points, and friction acts the other way") {
  const Scene scene = load_scene("slide.toml", R"(
dim = 3
grid = {min = [0, 0, 0], max = [2, 2, 1], cells = [8, 8, 4]}
body = {min = [0.6, 0.6, 0.3], max = [1.4, 1.4, 0.8], material = "stone"}
material.stone = {law = "linear-elastic", E = 1e6, nu = 0.3, rho = 1000}
rigid = [{name = "floor", half_plane = [[0, 0, 0.3], [0, 0, 1]], friction = 0.2}]
body_force = {value = [2.5, 1.7, -10]}
damping = {strategy = "viscous", c = 20}
stop = {residual = 0, time = 2}
probe = [{name = "block", kind = "body", fields = ["momentum.x", "momentum.y"]}]
)",
                                 {});
  const Summary s = run(scene, {.threads = 1});
  const double m = 320, load = std::hypot(2.5, 1.7), angle = std::atan2(1.7, 2.5);
  const double x = scenes::probe(s, "block", "momentum.x"), y = scenes::probe(s, "block", "momentum.y");
  CHECK(std::hypot(x, y) == Approx(m * (load - 0.2 * 10) / 20).epsilon(1e-6));
  CHECK(std::abs(std::atan2(y, x) - angle) < 1e-7);
  const double T_x = s.contacts.at("floor.force_x"), T_y = s.contacts.at("floor.force_y");
  CHECK(std::abs(std::atan2(-T_y, -T_x) - angle) < 1e-7);
  CHECK(std::hypot(T_x, T_y) == Approx(0.2 * s.contacts.at("floor.force_z")).epsilon(1e-9));
  CHECK(s.contacts.at("floor.force_z") == Approx(10 * m).epsilon(1e-6));
}

TEST_CASE("Hertz's cylinder and sphere press with their force and pressure, and a punch and a cone with Love's") {
  struct Variant {
    const char* scene;
    double force, tolerance;
  };
  const double pi = std::acos(-1.0);
  for (const Variant& one : {Variant{"hertz_cylinder", -pi * 1e-3 / 8, 0.01}, Variant{"hertz_sphere", -4e-4 / 3, 0.02},
                             Variant{"rigid_punch", -4e-4, 0.02}, Variant{"rigid_cone", -4e-4 * pi, 0.03}}) {
    CAPTURE(one.scene);
    const Summary s = run_ladder(one.scene);
    REQUIRE(s.status == RunStatus::equilibrium);
    const auto force = std::ranges::find_if(s.contacts, [](const auto& of) { return of.first.ends_with("force_y"); });
    CHECK(force->second == Approx(one.force).epsilon(one.tolerance));
  }
}

TEST_CASE("a contact that gives way, and whose forces another update would make others, is at no equilibrium") {
  const Summary s = scenes::run_text(
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [4, 1.5]\ncells = [64, 24]\n[body]\nmax = [4, 1.03]\nmaterial = 'm'\n"
      "placement = 'gauss'\n[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1\n"
      "[[support]]\nface = 'bottom'\n[[rigid]]\nname = 'disc'\ndisc = [1.02, 1.53]\nradius = 0.5\n"
      "motion = ['0', -0.002]\n[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-8\n");
  CAPTURE(s.reason, s.notes);
  CHECK((s.status != RunStatus::equilibrium ||
         std::ranges::none_of(s.notes, [](const auto& note) { return note.starts_with("contact gives way by"); })));
}

TEST_CASE("the moment of a rigid body that does not turn is about the position that it names, which moves with it") {
  const auto pressed = [](const char* about) {
    return scenes::run_text(
        std::string(
            "dim = 2\n[grid]\nmin = [0, 0]\nmax = [1, 1.5]\ncells = [4, 6]\n[body]\nmax = [1, 1]\nmaterial = 'm'\n"
            "[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\nrho = 1000\n[[support]]\nface = 'bottom'\n"
            "[[rigid]]\nname = 'plate'\nmin = [-0.5, 1]\nmax = [1.5, 1.3]\nmotion = ['0', -0.01]\n") +
        about + "\n[damping]\nstrategy = 'auto'\n");
  };
  const Summary s = pressed("about = [0.2, 1]"), of_origin = pressed("");
  REQUIRE(s.status == RunStatus::equilibrium);
  const double force = s.contacts.at("plate.force_y");
  REQUIRE(force < -1000);
  CHECK(s.contacts.at("plate.moment_z") == Approx(0.3 * force).epsilon(1e-3));  // its middle is at 0.5
  CHECK(of_origin.contacts.at("plate.moment_z") == Approx(0.5 * force).epsilon(1e-3));
}

TEST_CASE("a rigid body that presses on what a support holds is told so, and not to take smaller cells") {
  for (const char* rigid :
       {"half_plane = [[0.05, 0], [1, 0]]", "half_plane = [[0, 0], [1, 0]]\nmotion = ['0.02*min(t/0.01,1)', 0]"}) {
    CAPTURE(rigid);
    const Summary s = scenes::run_text(
        std::string("dim = 2\n[grid]\nmin = [0, 0]\nmax = [1, 1.5]\ncells = [8, 12]\n[body]\nmax = [1, 1.03]\n"
                    "material = 'm'\nplacement = 'gauss'\n[material.m]\nlaw = 'linear-elastic'\nE = 1e6\nnu = 0.3\n"
                    "rho = 1\n[[support]]\nface = 'left'\nname = 'side'\n[[rigid]]\nname = 'plate'\n") +
        rigid + "\n[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-8\n");
    CAPTURE(s.reason);
    CHECK(s.status != RunStatus::equilibrium);
    CHECK_THAT(s.reason, Catch::Contains("'plate' is") && Catch::Contains("that a support holds there, as by 'side'"));
  }
}

TEST_CASE("the sides of an outline that are shorter than a cell touch a round bar all around") {
  const Summary s = run(load_scene("bar.toml",
                                   around_a_bar("0", "max_motion = 'none'", 1e6) +
                                       "[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-6\ntime = 30\n",
                                   {}),
                        {.threads = 1});
  REQUIRE(s.status == RunStatus::equilibrium);
  CHECK(s.contacts.at("bar.contact_area") ==
        Approx(std::acos(-1.0) / 2).epsilon(0.02));  // the ends of chords may be open
}

TEST_CASE("clay goes around a bar that is dragged through many phases without letting go of it") {
  const Summary s = run(load_scene("bar.toml",
                                   around_a_bar("0.05*max(t-2,0)", "max_motion = 0.1", 1) +
                                       "[damping]\nstrategy = 'one-sided'\n[stop]\nresidual = 0\ntime = 5\n",
                                   {}),
                        {.threads = 1});
  REQUIRE(s.status == RunStatus::end_time);
  CHECK(s.contacts.at("bar.contact_area") == Approx(std::acos(-1.0) / 2).epsilon(0.05));
}

TEST_CASE("a cone that draws the surface of clay to many times its length bears on as it goes") {
  const TemporaryFolder folder;
  const Scene scene = scenes::load("ladder/cone_penetration",
                                   {"grid.x=[[0.0, 4.0, 8], [4.0, 14.0, 6, 1.2]]",
                                    "grid.y=[[0.0, 6.0, 4], [6.0, 27.0, 42]]", "constants.v=0.4", "stop.time=15"});
  REQUIRE(run(scene, {.out = folder.path(), .threads = 1}).status == RunStatus::end_time);
  const auto history = columns_of(folder.path() / "history.csv");
  const std::vector<double>&t = history.at("t"), &force = history.at("cone.force_y");
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < t.size(); ++k)
    if (t[k] > 10) sum -= force[k], count += 1;  // from four radii on
  REQUIRE(count > 20);
  // Of a deep cone 10.8 π; here it is less deep, and its cells are half as long as it is wide.
  CHECK(sum / count > 7 * std::acos(-1.0));
  CHECK(sum / count < 12 * std::acos(-1.0));
}

TEST_CASE(
    "a border of domains that is drawn to three times its length says that something may pass between its points") {
  const std::string strip =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [7, 1]\ncells = [28, 4]\n[body]\nmax = [1, 0.5]\nmaterial = 'm'\n"
      "[material.m]\nlaw = 'neo-hookean'\nE = 1000\nnu = 0\nrho = 1\n"
      "[phase]\nmax_motion = 0.3\nquadrature = 'domains'\n[[support]]\nface = 'left'\nkind = 'roller'\n"
      "[[support]]\nface = 'bottom'\nkind = 'roller'\n"
      "[[traction]]\nline = [[1, 0], [1, 0.5]]\nvalue = ['pull*min(t/10,1)', 0]\n"
      "[[rigid]]\nname = 'plate'\nhalf_plane = [[0, 0.5], [0, -1]]\nmotion = ['0', '-0.01*min(t,1)']\n"
      "[damping]\nstrategy = 'cundall'\n[stop]\nresidual = 1e-3\ntime = 30\n[constants]\n";
  const auto notes_at = [&](const char* pull) {
    const Summary s = run(load_scene("strip.toml", strip + pull, {}), {.threads = 1});
    REQUIRE(s.status == RunStatus::equilibrium);
    return fmt::format("{}", fmt::join(s.notes, "\n"));
  };
  CHECK_THAT(notes_at("pull = 500"), !Catch::Contains("may pass between its points"));
  CHECK_THAT(notes_at("pull = 1700"), Catch::Contains("a border in the contact plate is drawn to 3.") &&
                                          Catch::Contains("may pass between its points"));
}

TEST_CASE(
    "around an axis the figures of a rigid body are those of all of it, and its radial force a sum without sign") {
  const std::string bar =
      "dim = 2\n[constants]\nnu = 0.25\n[grid]\nmin = [0, 0]\nmax = [2, 2]\ncells = [16, 16]\n"
      "[[body]]\nmax = [1, 1]\nmaterial = 'm'\nstate = 'axisymmetric'\nplacement = 'gauss'\n"
      "[material.m]\nlaw = 'linear-elastic'\nE = 1000\nnu = 'nu'\nrho = 1\n"
      "[[support]]\nface = 'bottom'\nkind = 'roller'\n[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-9\n";
  const auto run_with = [&](const std::string& rigid, const std::vector<std::string>& set = {}) {
    return run(load_scene("bar.toml", bar + rigid, set), {.threads = 1});
  };
  const double pi = std::acos(-1.0);
  // A ring that is 1 % too narrow: p = E δ/(a (1 + ν)(1 − 2ν)) in plane strain, on 2π a H.
  const Summary ring = run_with(
      "[[rigid]]\nname = 'lid'\nhalf_plane = [[0, 1], [0, -1]]\n"
      "[[rigid]]\nname = 'ring'\nhalf_plane = [[0.99, 0], [-1, 0]]\n");
  REQUIRE(ring.status == RunStatus::equilibrium);
  CHECK(ring.contacts.at("ring.force_x") == Approx(-2 * pi * 1000 * 0.01 / (1.25 * 0.5)).epsilon(1e-6));
  CHECK(ring.contacts.at("ring.force_y") == Approx(0).margin(1e-6));
  CHECK(ring.contacts.at("ring.contact_area") == Approx(2 * pi));
  CHECK(ring.contacts.count("ring.moment_z") == 0);
  // A free plate bears the force on it: E δ/H on π a².
  const Summary plate = run_with(
      fmt::format("[[rigid]]\nname = 'plate'\nhalf_plane = [[0, 1], [0, -1]]\nfree = true\nforce = [0, {:.15g}]\n",
                  -10 * pi),
      {"constants.nu=0"});
  REQUIRE(plate.status == RunStatus::equilibrium);
  CHECK(plate.contacts.at("plate.force_y") == Approx(-10 * pi).epsilon(1e-6));
  CHECK(plate.contacts.at("plate.displacement_y") == Approx(-0.01).epsilon(1e-5));
  CHECK(plate.contacts.at("plate.contact_area") == Approx(pi));
}

TEST_CASE("a free footing settles until the ground bears its weight, by every way to rest, and always as far") {
  double settled = 0;
  for (const char* way : {"damping.strategy=viscous", "damping.strategy=auto", "damping.strategy=kinetic",
                          "damping.strategy=cundall", "solve.method=newton", "solve.method=lbfgs"}) {
    CAPTURE(way);
    const Summary s = run_ladder("free_footing", {way});
    REQUIRE(s.status == RunStatus::equilibrium);
    CHECK(s.contacts.at("footing.force_y") == Approx(-600).epsilon(1e-6));
    CHECK(s.contacts.at("footing.force_x") == Approx(0).margin(1e-6));
    CHECK(s.reactions.at("ground")[1] == Approx(600).epsilon(1e-6));
    if (settled == 0) settled = s.contacts.at("footing.displacement_y");
    CHECK(settled < -1e-3);
    CHECK(s.contacts.at("footing.displacement_y") == Approx(settled).epsilon(1e-3));  // distance to equilibrium
  }
}

TEST_CASE("a rigid body that overlaps a body by more than half a cell when the run begins is refused") {
  CHECK_THROWS_WITH(run_ladder("pressed_plate", {"constants.gap=-0.07", "constants.delta=0.08"}),
                    Catch::Contains("pressed_plate.toml:45:1: 'plate' overlaps body[0] by 0.61 cells"));
}

namespace {

/// A block, 1 by 1.1, E = 100, ν = 0, under a plate that presses it by 1 % and drags it by 0.004 in proportion: N = 1.
Summary pressed_and_dragged(double friction, int shares, const std::string& plate, const std::string& floor) {
  const test::TemporaryFolder folder;
  return run(load_scene(folder.write(
                 "scene.toml",
                 fmt::format("dim = 2\n[grid]\nmin = [0, 0]\nmax = [1, 1.5]\ncells = [4, 6]\n"
                             "[[body]]\nmax = [1, 1.1]\nmaterial = 'r'\nplacement = 'gauss'\n"
                             "[material.r]\nlaw = 'linear-elastic'\nE = 100.0\nnu = 0.0\nrho = 1.0\n"
                             "[[support]]\nface = 'bottom'\ncomponent = 'x'\n{}\n[[support]]\nface = 'bottom'\n"
                             "component = 'y'\n"
                             "[[rigid]]\nname = 'plate'\nhalf_plane = [[0, 1.1], [0, -1]]\nmotion = {}\nfriction = {}\n"
                             "[solve]\nmethod = 'newton'\nload_steps = {}\n[stop]\nresidual = 1e-9\ntime = 1\n",
                             floor, plate, friction, shares))),
             {.threads = 1});
}

}  // namespace

TEST_CASE("a static solver takes rigid bodies along in the shares of the load, and friction remembers that way alone") {
  const std::string pressing = "['0', '-0.011*t']", both = "['0.004*t', '-0.011*t']";
  for (const double friction : {0.2, 0.05}) {  // the block sticks all the way, or slides all the way
    for (const int shares : {1, 10, 40}) {
      CAPTURE(friction, shares);
      // The floor that goes back drags as the plate that goes on does.
      const Summary plate = pressed_and_dragged(friction, shares, both, ""),
                    floor = pressed_and_dragged(friction, shares, pressing, "u = '-0.004*t'");
      REQUIRE(plate.status == RunStatus::equilibrium);
      REQUIRE(floor.status == RunStatus::equilibrium);
      CHECK(std::abs(plate.contacts.at("plate.force_x")) ==
            Approx(std::abs(floor.contacts.at("plate.force_x"))).epsilon(0.01));
      if (friction == 0.05)
        CHECK(std::abs(plate.contacts.at("plate.force_x") / plate.contacts.at("plate.force_y")) ==
              Approx(0.05).epsilon(0.03));
    }
  }
}

TEST_CASE("a rigid body in the middle of a body, which bears on no border, is refused") {
  CHECK_THROWS_WITH(
      run_ladder("pressed_plate", {"rigid=[{name='disc', disc=[0.27, 0.5], radius=0.12}]"}),
      Catch::Contains("'disc' is inside body[0]: its surface at (") && Catch::Contains("expected a hole in the body"));
}

TEST_CASE("a rigid body whose motion has no value any more ends the run, which says so") {
  const Summary s = run_ladder(
      "pressed_plate", {"rigid=[{name='plate', half_plane=[[0, 'top'], [0, -1]], motion=['0', '-0.02*sqrt(1 - t)']}]",
                        "constants.top=1.0", "stop.time=0", "stop.residual=1e-9"});
  CAPTURE(s.reason);
  CHECK(s.exit_status != 0);
  CHECK_THAT(s.reason, Catch::Contains("rigid[0].motion") && Catch::Contains("is not a number"));
}

TEST_CASE("auto goes downhill under a free rigid plate, whose place is no history of the body") {
  const Summary s =
      run_ladder("pressed_plate", {"rigid=[{name='plate', half_plane=[[0.0, 'H'], [0.0, -1.0]], free=true, force=['0', "
                                   "'-M*delta/H*W']}]",
                                   "stop.residual=1e-6"});
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.rhs_evaluations < 100);  // 413 of a damped motion, 10 under a pressure
  CHECK(s.reactions.at("floor").at(1) == Approx(7188.20015).epsilon(1e-5));
}

TEST_CASE("Newton's method brings a free disc to rest in a groove, however little weighs on it") {
  const std::string groove = R"toml(
dim = 2
[constants]
W = 1.0
[grid]
min = [0, 0]
max = [2, 1.5]
cells = [16, 12]
[[body]]
name = "left"
polygon = [[0, 0], [1, 0], [1, 0.4], [0, 1.2]]
material = "soil"
[[body]]
name = "right"
polygon = [[1, 0], [2, 0], [2, 1.2], [1, 0.4]]
material = "soil"
[material.soil]
law = "linear-elastic"
E = 1e5
nu = 0.3
rho = 1
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
[[support]]
face = "right"
kind = "roller"
[[rigid]]
name = "disc"
disc = [1, 1.1]
radius = 0.3
free = true
force = ["0", "-W"]
[solve]
method = "newton"
[stop]
residual = 1e-8
)toml";
  for (const double weight : {1.0, 0.3, 0.1, 0.03, 0.01}) {
    CAPTURE(weight);
    const Summary rests = scenes::run_text(groove, {fmt::format("constants.W={}", weight)});
    CHECK(rests.status == RunStatus::equilibrium);
    CHECK(rests.contacts.at("disc.force_y") == Approx(-weight).epsilon(1e-6));
  }
}

TEST_CASE("a static solver in one load step remembers the friction of contact that closes as slow loading does") {
  // A conical cap comes down on a bar by a hundredth: as slip, that way would use up the friction.
  const std::string cap = R"toml(
dim = 2
[constants]
T = 1e-9
[grid]
min = [0, 0]
max = [2, 2]
cells = [16, 16]
[[body]]
name = "bar"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1.3]]
material = "m"
state = "axisymmetric"
[material.m]
law = "hencky"
E = 1000
nu = 0.25
rho = 1
[[support]]
face = "bottom"
kind = "roller"
[[support]]
face = "left"
kind = "roller"
[[rigid]]
name = "cap"
half_plane = [[0, 1.31], [-0.28734788556634544, -0.9578262852211514]]
free = true
force = [0, "-32*min(1, t/T)"]
friction = 0.2
[stop]
residual = 1e-7
)toml";
  const auto radial = [&](const std::vector<std::string>& way) {
    const Summary rests = scenes::run_text(cap, way);
    CHECK(rests.status == RunStatus::equilibrium);
    CHECK(rests.contacts.at("cap.force_y") == Approx(-32).epsilon(1e-5));
    return rests.contacts.at("cap.force_x");
  };
  const double slow = radial({"damping.strategy=auto", "constants.T=20"});
  for (const char* solver : {"newton", "lbfgs"}) {
    CAPTURE(solver);
    const std::vector<std::string> in_one{fmt::format("solve.method={}", solver), "rigid[0].force=[0, -32]"};
    const double one = radial(in_one), many = radial(scenes::with(in_one, {"solve.load_steps=20"}));
    CHECK(one == Approx(many).epsilon(0.01));
    CHECK(one == Approx(slow).epsilon(0.02));  // a motion swings by about that
  }
}

}  // namespace stillpoint::test
