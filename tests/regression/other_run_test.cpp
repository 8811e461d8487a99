// Runs that begin with the points of another run, and materials that change: what the points keep and what becomes
// another.
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "says.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using scenes::with;

namespace {

/// A column under its own weight, and the same from its points.
std::vector<std::string> column_of(const std::string& law) {
  return {"body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]", "stage=[]",
          "material.fill." + law,
          "probe=[{name='top', at=['h/2', '3*h'], fields=['u.y']}, {name='deep', at=['h/2', 'h/2'], "
          "fields=['stress.yy', 'stress.xx']}]"};
}
std::filesystem::path leaves(const test::TemporaryFolder& folder, const std::vector<std::string>& set) {
  const Scene scene = scenes::load("ladder/lifts", with(set, {"checkpoint.every_steps=1000"}));
  REQUIRE(run(scene, {.out = folder.path()}).status == RunStatus::equilibrium);
  return folder.path() / "checkpoint.h5";
}

}  // namespace

TEST_CASE("a run that begins with the points of another one at rest is at rest, with its stresses") {
  for (const std::string law : {"law=linear-elastic", "law=neo-hookean", "law=hencky", "law=drucker-prager"}) {
    for (const auto& [max_motion, quadrature] : {std::pair<std::string, std::string>{"'none'", "points"},
                                                 {"0.01", "points"},
                                                 {"'none'", "domains"},
                                                 {"0.01", "domains"}}) {
      if (law == "law=linear-elastic" && max_motion == "0.01") continue;  // its points do not move
      CAPTURE(law, max_motion, quadrature);
      std::vector<std::string> set = with(column_of(law), {"material.fill.nu=0.3", "phase.quadrature=" + quadrature});
      if (law == "law=drucker-prager") set.push_back("material.fill.c=1e6");
      const test::TemporaryFolder folder;
      const std::vector<std::string> first =
          max_motion == "'none'"
              ? set
              : with(set, {"solve.method=relaxation", "stop.residual=1e-9", "phase.max_motion=" + max_motion});
      const std::string from = "initial.from=" + leaves(folder, first).string();
      const Summary before = run(scenes::load("ladder/lifts", first));
      const Summary after = run(scenes::load("ladder/lifts", with(set, {from, "stop.residual=1e-9"})));
      CHECK(after.status == RunStatus::equilibrium);
      const double settled = std::abs(scenes::probe(before, "top", "u.y"));
      // Points have crossed lines of the grid by then, at which the functions of the new one are others.
      CHECK(std::abs(scenes::probe(after, "top", "u.y")) < 0.02 * settled);
      for (const char* stress : {"stress.yy", "stress.xx"})
        CHECK(scenes::probe(after, "deep", stress) == Approx(scenes::probe(before, "deep", stress)).epsilon(0.02));
    }
  }
}

TEST_CASE("another law that keeps a stress takes over that of another run, and one that keeps none is refused") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> set = with(column_of("law=hencky"), {"material.fill.nu=0.3"});
  const std::string from = "initial.from=" + leaves(folder, set).string();
  const Summary before = run(scenes::load("ladder/lifts", set));
  const Summary after = run(scenes::load("ladder/lifts", with(set, {from, "material.fill.law=mohr-coulomb",
                                                                    "material.fill.c=1e6", "stop.residual=1e-9"})));
  CHECK(after.status == RunStatus::equilibrium);
  CHECK(scenes::probe(after, "deep", "stress.xx") == Approx(scenes::probe(before, "deep", "stress.xx")).epsilon(0.02));
  CHECK_THROWS_WITH(run(scenes::load("ladder/lifts", with(set, {from, "material.fill.law=neo-hookean"}))),
                    Catch::Contains("'neo-hookean' is a law without history") &&
                        Catch::Contains("cannot take over the stress of 'hencky'"));
}

TEST_CASE("points do not become domains, nor domains points, from one run to another, and domains keep their corners") {
  const test::TemporaryFolder folder;
  const auto set = column_of("law=hencky");
  const std::string from = "initial.from=" + leaves(folder, with(set, {"phase.quadrature=domains"})).string();
  CHECK_THROWS_WITH(
      run(scenes::load("ladder/lifts", with(set, {from, "phase.quadrature=points"}))),
      Catch::Contains("the points of the other run represent domains, and those of this scene do not; expected "
                      "phase.quadrature = \"domains\" here"));
  CHECK_THROWS_WITH(
      scenes::load("ladder/lifts", with(set, {from, "phase.quadrature=domains", "phase.deformation=accumulated",
                                              "initial.displacements=zero"})),
      Catch::Contains("initial.displacements: domains remember their displacements by their corners"));
}

TEST_CASE("a checkpoint that is none, or of other bodies, is refused where the scene names it") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> set = column_of("law=hencky");
  const std::filesystem::path left = leaves(folder, set), none = folder.path() / "none.h5";
  CHECK_THAT(scenes::refusal("ladder/lifts", with(set, {"initial.from=" + none.string()})),
             Catch::Contains("initial.from: there is no file"));
  CHECK_THROWS_WITH(
      run(scenes::load("ladder/lifts", with(set, {"initial.from=" + (folder.path() / "summary.json").string()}))),
      Catch::Contains("initial.from") && Catch::Contains("is no checkpoint of this format"));
  CHECK_THROWS_WITH(
      run(scenes::load("ladder/lifts", with(set, {"initial.from=" + left.string(), "body[0].name=other"}))),
      Catch::Contains("no body of this scene has the name of one of the other run: ground"));
  CHECK_THROWS_WITH(
      run(scenes::load("ladder/lifts", with(set, {"initial.from=" + left.string(), "body[0].state=axisymmetric"}))),
      Catch::Contains("is one of state = 'plane-strain', and this scene of 'axisymmetric'"));
  CHECK_THROWS_WITH(
      run(scenes::load("ladder/lifts", with(set, {"initial.from=" + left.string(), "body[0].thickness=2"}))),
      Catch::Contains(
          "body[0].thickness=2: must be that of the other run, 1, whose points the body takes over, not 2"));
  CHECK_THAT(scenes::refusal("ladder/lifts", with(set, {"initial.displacements=zero"})),
             Catch::Contains("goes with from, another run"));
}

TEST_CASE("a body of another run that this scene lacks is refused by its name, unless a stage brings it") {
  const test::TemporaryFolder folder;
  const std::string below = "{name='below', max=['h', '2*h'], material='fill', state='plane-strain'}",
                    above = "{name='above', min=[0, '2*h'], max=['h', '3*h'], material='fill'}",
                    higher = "{name='higher', min=[0, '3*h'], max=['h', '4*h'], material='fill'}";
  const std::vector<std::string> set = with(column_of("law=hencky"), {"body=[" + below + ", " + above + "]"});
  const std::string from = "initial.from=" + leaves(folder, set).string();
  CHECK_THROWS_WITH(Simulation(scenes::load("ladder/lifts", with(set, {from, "body[0].name=ground"}))),
                    Catch::Contains("initial.from") &&
                        Catch::Contains("this scene lacks bodies of the other run: 'below'; it begins with 'ground', "
                                        "'above'; expected all bodies of the other run under their names"));
  CHECK_THROWS_WITH(Simulation(scenes::load("ladder/lifts", with(set, {from, "body=[" + below + "]", "probe=[]"}))),
                    Catch::Contains("this scene lacks bodies of the other run: 'above'; it begins with 'below'"));
  CHECK_NOTHROW(Simulation(scenes::load("ladder/lifts", with(set, {from, "stage=[{at=1, add=['above']}, {at=2}]"}))));
  CHECK_NOTHROW(Simulation(
      scenes::load("ladder/lifts", with(set, {from, "body=[" + below + ", " + above + ", " + higher + "]",
                                              "stage=[{at=1, add=['higher']}, {at=2, remove=['above']}]"}))));
}

TEST_CASE("a body whose shape is not that of the other run is told, and has that run's points all the same") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> set = column_of("law=hencky");
  const std::string from = "initial.from=" + leaves(folder, set).string(), told = "body[0] has another shape than in ";
  const Summary same = run(scenes::load("ladder/lifts", with(set, {from}))),
                shorter = run(scenes::load("ladder/lifts", with(set, {from, "body[0].max=['h', '2*h']", "probe=[]"})));
  CHECK_FALSE(test::says(same, told));
  CHECK(test::says(shorter, told));
  CHECK(shorter.points == same.points);
}

TEST_CASE("a body of another shape than in the other run, of which a border is needed, is refused") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> set = column_of("law=hencky");
  const std::string from = "initial.from=" + leaves(folder, set).string();
  const std::string plate = "rigid=[{name='plate', half_plane=[[0, '5*h'], [0, -1]], motion=['0', '0']}]";
  CHECK_THROWS_WITH(run(scenes::load("ladder/lifts",
                                     with(set, {from, plate, "body[0].max=['h', '5*h']", "solve.method=relaxation"}))),
                    Catch::Contains("the other run placed no material point near") &&
                        Catch::Contains("expected bodies of the same shape in both"));
}

TEST_CASE("supports hold a body of another run wherever it has moved to, and its ground stays at rest") {
  // Strained soil has moved away from the smooth side by far less than a cell, which a support took for a gap.
  const std::vector<std::string> slope = {"grid.cells=[34, 11]", "material.soil.E=1e7"};
  const test::TemporaryFolder folder;
  const Summary before =
      run(scenes::load("stable_slope", with(slope, {"checkpoint.every_steps=1000"})), {.out = folder.path()});
  REQUIRE(before.status == RunStatus::equilibrium);
  const std::string from = "initial.from=" + (folder.path() / "checkpoint.h5").string();
  for (const char* displacements : {"kept", "zero"}) {
    CAPTURE(displacements);
    const Summary after =
        run(scenes::load("stable_slope", with(slope, {from, std::string("initial.displacements=") + displacements})));
    CAPTURE(after.reason);
    REQUIRE(after.status == RunStatus::equilibrium);
    CHECK(std::abs(scenes::probe(after, "crest", "u.y")) < 0.02 * std::abs(scenes::probe(before, "crest", "u.y")));
  }
}

TEST_CASE("a run from another one tells what its supports bear") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> set = with(column_of("law=hencky"), {"support[0].name=base"});
  const std::string from = "initial.from=" + leaves(folder, set).string();
  const Summary before = run(scenes::load("ladder/lifts", set)),
                after = run(scenes::load("ladder/lifts", with(set, {from})));
  REQUIRE(before.reactions.size() == 1);
  REQUIRE(after.reactions.size() == 1);
  CHECK(after.reactions.at("base")[1] == Approx(before.reactions.at("base")[1]).epsilon(1e-3));
}

TEST_CASE("what a parameter is by place belongs to the material: another run's, or a stage's, that is changed for it") {
  struct Case {
    std::string before, number, formula;  // materials, of which the last two are the same
  };
  const std::string sand = "law='drucker-prager', nu=0.3, phi=0, ";
  const auto [before, number, formula] = GENERATE_COPY(
      // twice as heavy
      Case{sand + "E=2e7, rho=1800, c=1e6", sand + "E=2e7, rho=3600, c=1e6", sand + "E=2e7, rho='3600 + 0*y', c=1e6"},
      Case{sand + "E=2e7, rho='1800 + 0*y', c=1e6", sand + "E=2e7, rho=3600, c=1e6",
           sand + "E=2e7, rho='3600 + 0*x', c=1e6"},
      // less cohesive, so that it yields; less stiff, which heavier ground shows
      Case{sand + "E=2e7, rho=1800, c='1e6 + 0*y'", sand + "E=2e7, rho=1800, c=1e4",
           sand + "E=2e7, rho=1800, c='1e4 + 0*y'"},
      Case{sand + "E='2e7 + 0*y', rho=1800, c=1e6", sand + "E=5e6, rho=3600, c=1e6",
           sand + "E='5e6 + 0*y', rho=3600, c=1e6"});
  CAPTURE(before, formula);
  const std::vector<std::string> column = {
      "body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]",
      "probe=[{name='top', at=['h/2', '3*h'], fields=['u.y']}, {name='deep', at=['h/2', 'h/2'], "
      "fields=['stress.yy', 'stress.xx', 'plastic_strain']}]",
      "phase.dilatation=cells", "solve.load_steps=4"};
  const auto material = [](const std::string& name, const std::string& law) { return name + "={" + law + "}"; };
  const test::TemporaryFolder folder;
  const std::filesystem::path left =
      leaves(folder, with(column, {"stage=[]", "material.fill.rho=1", material("material.fill", before)}));
  const auto from_other = [&](const std::string& law) {
    return run(scenes::load(
        "ladder/lifts", with(column, {"stage=[]", "initial.from=" + left.string(), material("material.fill", law)})));
  };
  const auto by_stage = [&](const std::string& law) {
    return run(scenes::load("ladder/lifts",
                            with(column, {"stage=[{at=1, change=['ground'], material=['other']}]",
                                          material("material.fill", before), material("material.other", law)})));
  };
  const auto agree = [](const Summary& a, const Summary& b) {
    REQUIRE(a.status == RunStatus::equilibrium);
    REQUIRE(b.status == RunStatus::equilibrium);
    for (const char* field : {"stress.yy", "stress.xx", "plastic_strain"})
      CHECK(scenes::probe(a, "deep", field) == Approx(scenes::probe(b, "deep", field)).epsilon(1e-6).margin(1e-9));
    CHECK(scenes::probe(a, "top", "u.y") == Approx(scenes::probe(b, "top", "u.y")).epsilon(1e-5).margin(1e-9));
  };
  agree(from_other(number), from_other(formula));
  agree(by_stage(number), by_stage(formula));
}

TEST_CASE("an elastic body goes on with its deformation whether its stiffness is a number or a formula") {
  const test::TemporaryFolder folder;
  for (const std::string law : {"linear-elastic", "hencky"}) {
    const auto fill = [&](const std::string& E) {
      return std::vector<std::string>{"material.fill={law='" + law + "', E=" + E + ", nu=0.3, rho=1800}"};
    };
    const std::string of_number = "1e7", of_formula = "'1e7 + 0*y'";
    const std::vector<std::string> column = column_of("nu=0.3");
    for (const auto& [first, second] : {std::pair{of_number, of_formula}, std::pair{of_formula, of_number}}) {
      CAPTURE(law, first, second);
      const test::TemporaryFolder own;
      const std::string from = "initial.from=" + leaves(own, with(column, fill(first))).string();
      const Summary before = run(scenes::load("ladder/lifts", with(column, fill(first)))),
                    after = run(scenes::load("ladder/lifts", with(with(column, fill(second)), {from})));
      REQUIRE(after.status == RunStatus::equilibrium);
      CHECK(std::abs(scenes::probe(after, "top", "u.y")) < 0.02 * std::abs(scenes::probe(before, "top", "u.y")));
    }
  }
}

TEST_CASE("clay that a body becomes has the overconsolidation and the void ratio of its place") {
  const auto changed_to = [](const std::string& clay) {
    return run(
        scenes::load("ladder/lifts",
                     {"body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]",
                      "stage=[{at=1, change=['ground'], material=['clay']}]", "solve.load_steps=4",
                      "material.clay={law='cam-clay', M=1.2, lambda=0.2, kappa=0.04, nu=0.3, rho=1800, " + clay + "}",
                      "probe=[{name='deep', at=['h/2', 'h/2'], fields=['pc', 'void_ratio']}]"}));
  };
  const Summary number = changed_to("e0=1.5, OCR=5"), formula = changed_to("e0='1.5 + 0*y', OCR='5 + 0*y'");
  REQUIRE(number.status == RunStatus::equilibrium);
  REQUIRE(formula.status == RunStatus::equilibrium);
  for (const char* field : {"pc", "void_ratio"})
    CHECK(scenes::probe(formula, "deep", field) == Approx(scenes::probe(number, "deep", field)).epsilon(1e-9));
}

namespace {

/// A column that settles under its own weight by more than half a cell.
std::vector<std::string> settling_column(const std::vector<std::string>& more) {
  return with({"body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]",
               "probe=[{name='top', at=['h/2', '3*h'], fields=['u.y']}]", "constants.M=4e5", "phase.max_motion=0.05",
               "grid.cells=[2, 48]", "grid.basis=quadratic", "solve.method=relaxation", "damping.strategy=viscous",
               "stop.residual=1e-9"},
              more);
}
/// A plate that comes down on it from the time t on, from 0.02 m above where it has settled to.
std::string plate_from(double settled, const std::string& t) {
  return fmt::format(
      "rigid=[{{name='plate', half_plane=[[0, {:.9g}], [0, -1]], motion=['0', '-0.05*min(max({}, 0), 1)']}}]",
      3 + settled + 0.02, t);
}
double force_on_plate(const Summary& s) { return s.contacts.at("plate.force_y"); }

const std::vector<std::string> in_place = {"material.fill.law=linear-elastic", "phase.max_motion=none",
                                           "grid.basis=linear"};

}  // namespace

TEST_CASE("what comes down on a body of another run meets it where that has left its border, as in a stage") {
  struct Case {
    std::vector<std::string> law;
    double tolerance;  // the border follows points through phases in the stage, and is fitted to them after another run
  };
  for (const auto& [law, tolerance] :
       {Case{{"material.fill.law=hencky", "phase.quadrature=points", "phase.deformation=accumulated"}, 0.05},
        {in_place, 5e-3},
        {{"material.fill.law=hencky", "phase.quadrature=domains", "grid.basis=linear", "grid.cells=[2, 24]"}, 2e-3},
        {{"material.fill.law=drucker-prager", "material.fill.c=1e6", "material.fill.phi=0"}, 5e-3}}) {
    CAPTURE(law);
    const test::TemporaryFolder folder;
    const std::vector<std::string> column = with(settling_column(law), {"stage=[]"});
    const std::string from = "initial.from=" + leaves(folder, column).string();
    const double settled = scenes::probe(run(scenes::load("ladder/lifts", column)), "top", "u.y");
    REQUIRE(settled < -0.125);  // two cells, of domains half a cell
    const Summary stages = run(
        scenes::load("ladder/lifts",
                     with(column, {plate_from(settled, "t - 40"), "stop.time=400", "stage=[{at=40, add=['plate']}]"})));
    CAPTURE(stages.reason);
    REQUIRE(stages.status == RunStatus::equilibrium);
    REQUIRE(force_on_plate(stages) < -1e3);
    for (const char* displacements : {"kept", "zero"}) {
      if (law[1] == "phase.quadrature=domains" && displacements == std::string("zero")) continue;
      CAPTURE(displacements);
      const std::string counts = std::string("initial.displacements=") + displacements;
      const Summary other = run(
          scenes::load("ladder/lifts", with(column, {from, counts, plate_from(settled, "t - 1"), "stop.time=400"})));
      CAPTURE(other.reason);
      CHECK(other.status == RunStatus::equilibrium);
      CHECK(force_on_plate(other) == Approx(force_on_plate(stages)).epsilon(tolerance));
      // And from a run that does nothing in between.
      const test::TemporaryFolder next;
      const std::string from_next = "initial.from=" + leaves(next, with(column, {from, counts})).string();
      const Summary third = run(scenes::load(
          "ladder/lifts", with(column, {from_next, counts, plate_from(settled, "t - 1"), "stop.time=400"})));
      CAPTURE(third.reason);
      CHECK(third.status == RunStatus::equilibrium);
      CHECK(force_on_plate(third) == Approx(force_on_plate(stages)).epsilon(tolerance));
    }
  }
}

TEST_CASE("a plate that presses on ground of small strain, which a stage has left in place, is at rest on its border") {
  const std::vector<std::string> column = with(settling_column(in_place), {"stage=[]"});
  constexpr double settled = -18e3 * 9 / (2 * 4e5);
  const Summary s = run(scenes::load("ladder/lifts", with(column, {plate_from(settled, "t - 40"), "stop.time=400",
                                                                   "stage=[{at=40, add=['plate']}]"})));
  CAPTURE(s.reason);
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(force_on_plate(s) == Approx(-4e5 * 0.03 / 3).epsilon(1e-6));
}

TEST_CASE("a body bears its traction in another run as where it began, on the border that has moved") {
  const std::string block =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [2.5, 1.5]\ncells = [25, 15]\n[[body]]\nname = 'block'\nmax = [1, 1]\n"
      "material = 'm'\n[material.m]\nlaw = 'hencky'\nE = 1e5\nnu = 0.3\nrho = 1000\n"
      "[[support]]\nface = 'left'\nkind = 'roller'\n[[support]]\nface = 'bottom'\nkind = 'roller'\n"
      "[[traction]]\nline = [[1, 0], [1, 1]]\nvalue = [4e4, 0]\n[damping]\nstrategy = 'auto'\n"
      "[phase]\nmax_motion = 0.1\n[stop]\nresidual = 1e-8\n[checkpoint]\nevery_steps = 100000\n"
      "[[probe]]\nname = 'mid'\nat = [0.5, 0.5]\nfields = ['stress.xx']\n";
  for (const char* load : {"traction[0].value=[1e4, 0]", "traction[0].value=[4e4, 0]",
                           "traction=[{line=[[1, 0], [1, 1]], pressure=-2e4}]"}) {
    CAPTURE(load);
    const test::TemporaryFolder folder;
    const Summary before = run(load_scene("scene.toml", block, {load}), {.out = folder.path()});
    REQUIRE(before.status == RunStatus::equilibrium);
    const Summary after = scenes::run_text(block, {load, "initial.from=" + (folder.path() / "checkpoint.h5").string()});
    CAPTURE(after.reason);
    CHECK(after.status == RunStatus::equilibrium);
    CHECK(scenes::probe(after, "mid", "stress.xx") == Approx(scenes::probe(before, "mid", "stress.xx")).epsilon(2e-3));
  }
}

TEST_CASE("points that another run has drawn apart, so that cells have more of them and fewer, are told") {
  const std::string block =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [2, 2]\ncells = [8, 8]\n[[body]]\nname = 'block'\nmax = [1, 1]\n"
      "material = 'm'\n[material.m]\nlaw = 'hencky'\nE = 1e5\nnu = 0\nrho = 1000\n"
      "[[support]]\nface = 'left'\nkind = 'roller'\n[[support]]\nface = 'bottom'\nkind = 'roller'\n"
      "[[traction]]\nline = [[1, 0], [1, 1]]\nvalue = ['P', 0]\n[constants]\nP = '1e5*ln(1.5)/1.5'\n"
      "[damping]\nstrategy = 'auto'\n[stop]\nresidual = 1e-8\n[checkpoint]\nevery_steps = 100000\n";
  const auto next_of = [&](const std::vector<std::string>& set) {
    const test::TemporaryFolder folder;
    REQUIRE(
        run(load_scene("scene.toml", block, with(set, {"initial.u=['0.5*x', 0]"})), {.out = folder.path()}).status ==
        RunStatus::equilibrium);
    return scenes::run_text(block, with(set, {"initial.from=" + (folder.path() / "checkpoint.h5").string()}));
  };
  CHECK(test::says(next_of({}),
                   "the points that the other run has moved fill cells inside the body by 0.75 to 1.5 of them"));
  CHECK_FALSE(test::says(next_of({"constants.P=0.1"}), "fill cells inside the body"));
}

TEST_CASE("points of another run that are fewer than the cells which they would have to fill are refused") {
  const std::string block =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [2, 2]\ncells = [8, 8]\n[[body]]\nname = 'block'\nmax = [1, 1]\n"
      "material = 'm'\n[material.m]\nlaw = 'hencky'\nE = 1e5\nnu = 0\nrho = 1000\n[[support]]\nface = 'bottom'\n"
      "[damping]\nstrategy = 'auto'\n[checkpoint]\nevery_steps = 100000\n";
  const test::TemporaryFolder folder;
  REQUIRE(run(load_scene("scene.toml", block, {}), {.out = folder.path()}).status == RunStatus::equilibrium);
  const std::string from = "initial.from=" + (folder.path() / "checkpoint.h5").string();
  // 4 points a cell: one a cell of half the size, and less than one of a third.
  CHECK(scenes::run_text(block, {from, "grid.cells=[16, 16]"}).status == RunStatus::equilibrium);
  CHECK_THROWS_WITH(
      scenes::run_text(block, {from, "grid.cells=[24, 24]"}),
      Catch::Contains("initial.from") && Catch::Contains("fill 2.2 times the cells of this grid in which they are"));
}

TEST_CASE("a stage that changes nothing, and a run that begins at rest with another's points, are in equilibrium") {
  const std::vector<std::string> column = settling_column(in_place);
  const Summary stages = run(scenes::load(
      "ladder/lifts",
      with(column, {"stage=[{at=20, equilibrium=true, ramp=1}, {at=40, equilibrium=true, ramp=1}]", "stop.time=400"})));
  CAPTURE(stages.reason);
  CHECK(stages.status == RunStatus::equilibrium);
  CHECK(stages.t < 60);
  const test::TemporaryFolder folder;
  const std::string from = "initial.from=" + leaves(folder, with(column, {"stage=[]"})).string();
  const Summary other = run(scenes::load("ladder/lifts", with(column, {"stage=[]", from, "stop.time=400"})));
  CAPTURE(other.reason);
  CHECK(other.status == RunStatus::equilibrium);
}

TEST_CASE("elastic boxes that move on represent domains in a scene with stages as well, and do not tear") {
  const std::string block =
      "dim = 2\n[grid]\nmin = [0, 0]\nmax = [2.2, 1.5]\ncells = [22, 15]\n"
      "[[body]]\nname = 'block'\nmax = [1, 1]\nmaterial = 'm'\n"
      "[[body]]\nname = 'extra'\nmin = [2.0, 0]\nmax = [2.2, 0.3]\nmaterial = 'm'\n"
      "[material.m]\nlaw = 'neo-hookean'\nE = 1e5\nnu = 0.3\nrho = 1000\n"
      "[[support]]\nname = 'left'\nface = 'left'\nkind = 'roller'\n[[support]]\nface = 'bottom'\nkind = 'roller'\n"
      "[[support]]\nface = 'right'\nkind = 'roller'\n[[traction]]\nline = [[1, 0], [1, 1]]\n"
      "value = ['4e4*min(t/2,1)', 0]\n[damping]\nstrategy = 'auto'\n[phase]\nmax_motion = 0.1\n"
      "[[stage]]\nat = 1\nadd = ['extra']\n[[stage]]\nat = 3\nremove = ['extra']\n[stop]\nresidual = 1e-8\n"
      "[[probe]]\nname = 'corner'\nat = [1, 1]\nfields = ['u.x']\n";
  const Summary s = scenes::run_text(block);
  CAPTURE(s.reason);
  REQUIRE(s.status == RunStatus::equilibrium);
  // Newton's method in a single phase without the stages: 0.4961.
  CHECK(scenes::probe(s, "corner", "u.x") == Approx(0.4961).epsilon(2e-3));
  CHECK(s.reactions.at("left")[0] == Approx(-4e4).epsilon(1e-3));
}
