// Stages: bodies that are placed and dug away, supports and loads that begin and end, materials that change.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using scenes::with;

namespace {

/// How far the top of lift k of n has come down since it was placed, (n − k) k + k − ½ times ρ g h²/M.
double settlement_of_lift(int k, int n) {
  constexpr double rho_g_over_M = 1.8e-3, H = 6;
  const double h = H / n;
  return -rho_g_over_M * h * h * ((n - k) * k + k - 0.5);
}

/// Rests in time, as the scene with a static solver does: each stage waits for equilibrium.
const std::vector<std::string> waiting = {"solve.method=relaxation", "stop.residual=1e-7"};
std::string lifts_that_wait() {
  std::string stages = "stage=[{at=0, equilibrium=true}";
  for (int k = 2; k <= 6; ++k)
    stages += fmt::format(", {{at={}, add=['lift {}'], ramp=0.2, equilibrium=true}}", k - 1, k);
  return stages + "]";
}

Summary built(const std::vector<std::string>& overrides) {
  std::vector<std::string> all = overrides;
  if (std::ranges::count(all, waiting[0]) > 0) all.push_back(lifts_that_wait());
  return run(scenes::load("ladder/lifts", all));
}

/// Two blocks, one on the other, between smooth walls; the upper one is dug away, or a prop is released, at t = 1.
Scene cut(const std::string& stage, const std::vector<std::string>& overrides = {}) {
  return scenes::load(
      "ladder/lifts",
      with({"body=[{name='below', max=['h', '3*h'], material='fill', state='plane-strain'}, "
            "{name='above', min=[0, '3*h'], max=['h', '4*h'], material='fill'}]",
            "stage=[" + stage + "]", "probe=[{name='below', at=['h/2', '3*h'], fields=['u.y', 'stress.yy']}]"},
           overrides));
}

/// A column of two lifts of 3 m, on whose top a surcharge of 1e5 Pa stands from a stage on, and until another one.
/// static_solver: by solve.method = "newton", or at rest in time.
Scene surcharged(bool begins, bool ends, bool static_solver, const std::vector<std::string>& overrides = {}) {
  const std::string wait = static_solver ? "}" : ", ramp=0.2, equilibrium=true}";
  std::string stages = "{at=1, add=['above']" + wait;
  if (!static_solver) stages = "{at=0, equilibrium=true}, " + stages;
  if (begins) stages += ", {at=2, hold=['surcharge']" + wait;
  if (ends) stages += ", {at=3, release=['surcharge']" + wait;
  std::vector<std::string> set = {
      "body=[{name='below', max=['h', '3*h'], material='fill', state='plane-strain'}, {name='above', min=[0, '3*h'], "
      "max=['h', '6*h'], material='fill'}]",
      "support=[{name='floor', face='bottom'}, {face='left', kind='roller'}, {face='right', kind='roller'}]",
      "stage=[" + stages + "]", "stop.residual=1e-8",
      "probe=[{name='middle', at=['h/2', '3*h'], fields=['u.y']}, {name='top', at=['h/2', '6*h'], fields=['u.y']}]"};
  if (begins) set.push_back("traction=[{name='surcharge', line=[[0, '6*h'], ['h', '6*h']], value=[0, -1e5]}]");
  if (!static_solver) set = with(set, waiting);
  return scenes::load("ladder/lifts", with(set, overrides));
}

/// The work that has been done on a body when its run ends [J].
double external_work(const Scene& scene) {
  const Summary s = run(scene);
  CHECK(s.status == RunStatus::equilibrium);
  return s.external_work.value();
}

/// A slope of one point a cell, in which a point's mean over its cell is its own: so phase.dilatation changes nothing.
const std::string slope_of_one_point_a_cell =
    "dim = 2\n[grid]\nmin = [0, 0]\nmax = [6, 4]\ncells = [12, 8]\n"
    "[[body]]\nname = 'base'\nmax = [6, 1]\nmaterial = 'stiff'\nstate = 'plane-strain'\npoints_per_cell = 1\n"
    "placement = 'gauss'\n"
    "[[body]]\nname = 'slope'\npolygon = [[0, 1], [5, 1], [3, 3], [0, 3]]\nmaterial = 'stiff'\n"
    "points_per_cell = 1\nplacement = 'gauss'\n"
    "[material.stiff]\nlaw = 'mohr-coulomb'\nE = 5e7\nnu = 0.3\nrho = 2000\nc = 15e3\nphi = 25\n"
    "[material.weak]\nlaw = 'mohr-coulomb'\nE = 5e7\nnu = 0.3\nrho = 2000\nc = 3e3\nphi = 25\n"
    "[phase]\nmax_motion = 'none'\n[[support]]\nface = 'bottom'\n[[support]]\nface = 'left'\nkind = 'roller'\n"
    "[body_force]\nvalue = [0, -10]\n[solve]\nmethod = 'newton'\n[stop]\nresidual = 1e-6\n"
    "[[probe]]\nname = 'crest'\nat = [2.9, 2.9]\nfields = ['u.x', 'u.y']\n";

}  // namespace

TEST_CASE("an embankment in six lifts settles as the closed solution says, by a static solver and in time") {
  for (const auto& way : {std::vector<std::string>{},
                          {"solve.method=cg"},
                          {"solve.method=lbfgs"},
                          with(waiting, {"damping.strategy=auto"}),
                          with(waiting, {"damping.strategy=viscous"}),
                          with(waiting, {"damping.strategy=cundall"})}) {
    CAPTURE(way);
    const Summary s = built(way);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(s.stages.size() == 5);
    for (int k = 1; k <= 6; ++k)
      CHECK(scenes::probe(s, fmt::format("lift {}", k), "u.y") == Approx(settlement_of_lift(k, 6)).epsilon(1e-4));
  }
}

TEST_CASE("lifts of a law that keeps its stress settle by as much, to the square of their strain") {
  for (const std::string law :
       {"law=drucker-prager,c=1e9", "law=mohr-coulomb,c=1e9", "law=neo-hookean", "law=hencky"}) {
    CAPTURE(law);
    const std::size_t comma = law.find(',');
    std::vector<std::string> set = {"material.fill." + law.substr(0, comma)};
    if (comma != std::string::npos) set.push_back("material.fill." + law.substr(comma + 1));
    for (const auto& way : {std::vector<std::string>{"stop.residual=1e-7"}, waiting}) {
      const Summary s = built(with(set, way));
      CHECK(s.status == RunStatus::equilibrium);
      for (int k = 1; k <= 6; ++k)
        CHECK(scenes::probe(s, fmt::format("lift {}", k), "u.y") == Approx(settlement_of_lift(k, 6)).epsilon(0.02));
    }
  }
}

TEST_CASE("a body that is dug away leaves what lies below as if it had never been there, if that is elastic") {
  for (const std::string law : {"linear-elastic", "neo-hookean", "hencky"}) {
    CAPTURE(law);
    const std::string set = "material.fill.law=" + law;
    const Summary never =
        run(cut("{at=1}", {"body=[{name='below', max=['h', '3*h'], material='fill', state='plane-strain'}]", set}));
    const double left = scenes::probe(never, "below", "u.y");
    CHECK(left < 0);
    for (const auto& way : {std::vector<std::string>{}, waiting}) {
      const Summary dug = run(cut("{at=1, remove=['above']}", with({set}, way)));
      CHECK(dug.status == RunStatus::equilibrium);
      CHECK(dug.stages.at(0).status == RunStatus::equilibrium);
      CHECK(scenes::probe(dug, "below", "u.y") == Approx(left).epsilon(2e-3));  // 1 % of strain once more and back
    }
  }
}

TEST_CASE("what a stage puts out of balance comes on over its ramp: a slow one never overshoots, a sudden one does") {
  const auto lowest = [](const std::string& ramp) {
    double least = 0;
    SimulationOptions options;
    std::size_t column = 0;
    options.at_row = [&](const std::vector<std::string>& columns, const std::vector<double>& row) {
      while (columns.at(column) != "below.u.y") ++column;
      least = std::min(least, row[column]);
    };
    const Scene scene = scenes::load(
        "ladder/lifts",
        with(waiting,
             {"body=[{name='below', max=['h', '3*h'], material='fill', state='plane-strain'}, {name='above', "
              "min=[0, '3*h'], max=['h', '6*h'], material='fill'}]",
              "stage=[{at=1, add=['above']" + ramp + "}]", "damping.strategy=viscous", "damping.c=10",
              "probe=[{name='below', at=['h/2', '3*h'], fields=['u.y']}]", "output.every=0.01", "stop.time=8"}));
    const Summary s = run(scene, options);
    return least / scenes::probe(s, "below", "u.y");
  };
  CHECK(lowest(", ramp=5") < 1.01);
  CHECK(lowest(", ramp=0") > 1.1);
}

TEST_CASE("a stage that changes nothing changes nothing, while a body moves and while it stands on a wall") {
  for (const auto& [law, quadrature] : {std::pair<std::string, std::string>{"law=hencky", "points"},
                                        {"law=drucker-prager", "points"},
                                        {"law=hencky", "domains"},
                                        {"law=drucker-prager", "domains"}}) {
    CAPTURE(law, quadrature);
    const std::vector<std::string> column = {
        "body=[{name='ground', max=['h', '5*h'], material='fill', state='plane-strain'}]",
        "support=[{face='left', kind='roller'}, {face='right', kind='roller'}]",
        "wall=[{name='floor', face='bottom'}]",
        "probe=[{name='top', at=['h/2', '5*h'], fields=['u.y', 'v.y']}]",
        "material.fill." + law,
        "solve.method=relaxation",
        "damping.strategy=viscous",
        "damping.c=2",
        "phase.max_motion=0.02",  // points take over velocities with and without the stage
        "phase.quadrature=" + quadrature,
        "stop.residual=0",
        "stop.time=0.5"};
    std::vector<std::string> set = column;
    if (law == "law=drucker-prager") set.push_back("material.fill.c=1e9");
    const Summary without = run(scenes::load("ladder/lifts", with(set, {"stage=[]"})));
    const Summary staged = run(scenes::load("ladder/lifts", with(set, {"stage=[{at=0.1, ramp=0.4}]"})));
    REQUIRE(staged.stages.size() == 1);
    // The stage ends a phase, which is one more of some twenty.
    CHECK(scenes::probe(staged, "top", "u.y") == Approx(scenes::probe(without, "top", "u.y")).epsilon(0.02));
    CHECK(scenes::probe(staged, "floor", "normal") == Approx(scenes::probe(without, "floor", "normal")).epsilon(0.02));
    CHECK(scenes::probe(without, "floor", "normal") > 0);
  }
}

TEST_CASE("domains go from stage to stage with their corners, and a load goes on where it was on the body") {
  // A column drawn out by two fifths, whose domains, each as wide as a cell, are halved on the way: ln λ/λ = P/M.
  constexpr double h = 1, M = 10e6, P = M / 4, stretch = 1.4296118;
  const auto drawn = [](const std::string& stages, const std::string& load) {
    return run(scenes::load(
        "ladder/lifts",
        {"body=[{name='ground', max=['h', '4*h'], material='fill', state='plane-strain', points_per_cell=1}]",
         "grid.max=['h', '10*h']", "grid.cells=[1, 20]", "body_force={value=[0, 0]}",
         "support=[{face='bottom'}, {face='left', kind='roller'}, {face='right', kind='roller'}]",
         "probe=[{name='top', at=['h/2', '4*h'], fields=['u.y']}, {name='middle', at=['h/2', '2*h'], "
         "fields=['stress.yy']}]",
         "traction=[{line=[[0, '4*h'], ['h', '4*h']], value=[0, \"" + load + "\"]}]", "material.fill.law=hencky",
         "solve.method=relaxation", "phase.max_motion=0.1", "phase.quadrature=domains", "stop.residual=1e-9", stages}));
  };
  for (const auto& [stages, load] : {std::pair<std::string, std::string>{"stage=[]", "M/4"},
                                     {"stage=[{at=0.5}, {at=2}]", "M/4"},
                                     {"stage=[{at=0.5}, {at=2}]", "M/4*min(t, 1)"}}) {
    CAPTURE(stages, load);
    const Summary s = drawn(stages, load);
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(scenes::probe(s, "top", "u.y") == Approx(4 * h * (stretch - 1)).epsilon(2e-4));  // paths of halves differ
    CHECK(scenes::probe(s, "middle", "stress.yy") == Approx(P).epsilon(1e-3));
  }
}

TEST_CASE("a support that is released hands its load on, and one that begins to hold does so where the body then is") {
  const std::string prop =
      "support=[{face='bottom'}, {face='left', kind='roller'}, {face='right', kind='roller'}, "
      "{name='prop', face='top', kind='roller'}]";
  const std::vector<std::string> column = {
      "body=[{name='below', max=['h', '6*h'], material='fill', state='plane-strain'}]", prop,
      "probe=[{name='top', at=['h/2', '6*h'], fields=['u.y']}]"};
  for (const auto& way : {std::vector<std::string>{}, waiting}) {
    CAPTURE(way);
    const Summary released =
        run(scenes::load("ladder/lifts", with(with(column, {"stage=[{at=1, release=['prop']}]"}), way)));
    CHECK(scenes::probe(released, "top", "u.y") == Approx(-1.8e-3 * 36 / 2).epsilon(1e-3));
    CHECK(released.reactions.count("prop") == 0);
    const Summary held = run(scenes::load("ladder/lifts", with(with(column, {"stage=[{at=1, hold=['prop']}]"}), way)));
    CHECK(scenes::probe(held, "top", "u.y") == Approx(-1.8e-3 * 36 / 2).epsilon(1e-3));
    CHECK(std::abs(held.reactions.at("prop").at(1)) < 1e-3 * 1800 * 10 * 6);  // it holds a body at rest
  }
}

TEST_CASE("a surcharge that a stage places on a lift of a stage before adds p H/M to what the lifts have settled by") {
  for (const bool static_solver : {true, false}) {
    CAPTURE(static_solver);
    const Summary s = run(surcharged(true, false, static_solver));
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(scenes::probe(s, "middle", "u.y") == Approx(settlement_of_lift(1, 2) - 1e5 * 3 / 1e7).epsilon(1e-3));
    CHECK(scenes::probe(s, "top", "u.y") == Approx(settlement_of_lift(2, 2) - 1e5 * 6 / 1e7).epsilon(1e-3));
    CHECK(s.reactions.at("floor").at(1) == Approx(6 * 18e3 + 1e5).epsilon(1e-4));
  }
  // A border that has moved before the load begins; strains are up to 2 %, of which this is first order.
  const Summary moved = run(surcharged(true, false, true, {"material.fill.law=hencky"}));
  CHECK(moved.status == RunStatus::equilibrium);
  CHECK(scenes::probe(moved, "top", "u.y") == Approx(settlement_of_lift(2, 2) - 1e5 * 6 / 1e7).epsilon(0.04));
}

TEST_CASE("a load that a stage takes away again leaves an elastic body as if it had never been there") {
  for (const bool static_solver : {true, false}) {
    CAPTURE(static_solver);
    const Summary s = run(surcharged(true, true, static_solver));
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(scenes::probe(s, "middle", "u.y") == Approx(settlement_of_lift(1, 2)).epsilon(1e-3));
    CHECK(scenes::probe(s, "top", "u.y") == Approx(settlement_of_lift(2, 2)).epsilon(1e-3));
    CHECK(s.reactions.at("floor").at(1) == Approx(6 * 18e3).epsilon(1e-4));
  }
}

TEST_CASE("a load that begins and ends with stages does the work of its coming on, and takes it back") {
  const double without = external_work(surcharged(false, false, true));
  // The weight goes down by p y/M, and the surcharge by p H/M as it comes on from nothing.
  const double of_weight = 18e3 * 36 / 2 * 1e5 / 1e7, of_surcharge = 1e5 * (1e5 * 6 / 1e7) / 2;
  CHECK(external_work(surcharged(true, false, true)) - without == Approx(of_weight + of_surcharge).epsilon(1e-3));
  CHECK(external_work(surcharged(true, true, true)) == Approx(without).epsilon(1e-3));
}

TEST_CASE("a load comes on over the ramp of its stage, and goes over that of the stage that ends it") {
  const auto furthest = [](const std::string& ramp, bool ends) {
    double least = 0, most = -1;
    SimulationOptions options;
    options.at_row = [&](const std::vector<std::string>& columns, const std::vector<double>& row) {
      const auto column = std::ranges::find(columns, "top.u.y");
      const double u = row[static_cast<std::size_t>(column - columns.begin())];
      if (row[0] >= (ends ? 11 : 1)) least = std::min(least, u), most = std::max(most, u);
    };
    const std::string load = "hold=['surcharge'], ramp=" + ramp, unload = "release=['surcharge'], ramp=" + ramp;
    const Scene scene = scenes::load(
        "ladder/lifts",
        with(waiting, {"body=[{name='ground', max=['h', '6*h'], material='fill', state='plane-strain'}]",
                       "body_force.value=[0, 0]", "damping.strategy=viscous", "damping.c=10", "output.every=0.01",
                       "traction=[{name='surcharge', line=[[0, '6*h'], ['h', '6*h']], value=[0, -1e5]}]",
                       "probe=[{name='top', at=['h/2', '6*h'], fields=['u.y']}]",
                       ends ? "stage=[{at=1, " + load + "}, {at=11, " + unload + "}]" : "stage=[{at=1, " + load + "}]",
                       "stop.residual=0", ends ? "stop.time=21" : "stop.time=11"}));
    run(scene, options);
    return ends ? most : least;
  };
  constexpr double settled = -1e5 * 6 / 1e7;
  CHECK(furthest("5", false) > 1.01 * settled);
  CHECK(furthest("0", false) < 1.1 * settled);
  CHECK(furthest("5", true) < -0.01 * settled);
  CHECK(furthest("0", true) > -0.1 * settled);
}

TEST_CASE("springs hold on from stage to stage what they held, also a body of small strain, which stays in place") {
  const auto top = [](const std::string& stages) {
    const Summary s = run(scenes::load(
        "ladder/lifts", {"body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]",
                         "support=[{face='bottom', kind='roller', stiffness=1e6}, {face='left', kind='roller'}, "
                         "{face='right', kind='roller'}]",
                         "stage=[" + stages + "]", "probe=[{name='top', at=['h/2', '3*h'], fields=['u.y']}]"}));
    return scenes::probe(s, "top", "u.y");
  };
  const double exact = -18e3 * 3 / 1e6 - 1.8e-3 * 9 / 2;
  CHECK(top("") == Approx(exact).epsilon(1e-6));
  CHECK(top("{at=1}, {at=2}") == Approx(exact).epsilon(1e-6));
}

TEST_CASE("ground that was drained carries what comes later by its water, once a stage makes it undrained") {
  const std::vector<std::string> soils = {"material.fill.law=mohr-coulomb",
                                          "material.fill.c=1e9",
                                          "material.wet.law=mohr-coulomb",
                                          "material.wet.c=1e9",
                                          "material.wet.E=M",
                                          "material.wet.nu=0",
                                          "material.wet.rho=1800",
                                          "material.wet.undrained=true",
                                          "material.wet.water_modulus=1e9",
                                          "material.wet.porosity=1",
                                          "stop.residual=1e-8"};
  const Summary s = run(scenes::load(
      "ladder/lifts",
      with(soils,
           {"body=[{name='below', max=['h', '3*h'], material='fill', state='plane-strain'}, {name='above', min=[0, "
            "'3*h'], max=['h', '6*h'], material='fill'}]",
            "stage=[{at=1, add=['above'], change=['below'], material=['wet']}]",
            "probe=[{name='middle', at=['h/2', '1.5*h'], fields=['pore_pressure', 'effective_stress.yy', "
            "'stress.yy']}]"})));
  CHECK(s.status == RunStatus::equilibrium);
  const double above = 3 * 18e3, own = 1.5 * 18e3;  // [Pa]
  CHECK(scenes::probe(s, "middle", "pore_pressure") == Approx(above * 1e9 / (1e9 + 1e7)).epsilon(0.01));
  CHECK(scenes::probe(s, "middle", "effective_stress.yy") == Approx(-own).epsilon(0.03));
  CHECK(scenes::probe(s, "middle", "stress.yy") == Approx(-own - above).epsilon(0.01));
}

TEST_CASE("bodies placed with K0 keep the stress of the weight above them, and only what they stand on is compressed") {
  const std::vector<std::string> placed = {
      "material.fill.law=mohr-coulomb",
      "material.fill.c=1e9",
      "material.heavy={law='mohr-coulomb', E='M', nu=0, rho=2500, c=1e9}",
      "body=[{name='below', max=['h', '3*h'], material='fill', state='plane-strain'}, {name='middle', min=[0, '3*h'], "
      "max=['h', '4*h'], material='fill'}, {name='above', min=[0, '4*h'], max=['h', '5*h'], material='heavy'}]",
      "stage=[{at=1, add=['middle', 'above'], K0='0.3+0.1*y'}]",
      "probe=[{name='above', at=['h/2', '4.5*h'], fields=['stress.xx', 'stress.yy', 'stress.zz']}, {name='middle', "
      "at=['h/2', '3.5*h'], fields=['stress.xx', 'stress.yy', 'stress.zz']}, {name='top', at=['h/2', '5*h'], "
      "fields=['u.y']}]"};
  for (const auto& way : {std::vector<std::string>{"stop.residual=1e-9"}, waiting}) {
    const Summary s = run(scenes::load("ladder/lifts", with(placed, way)));
    CHECK(s.status == RunStatus::equilibrium);
    const double of_above = -25e3 / 2, of_middle = -25e3 - 18e3 / 2;  // σ_yy [Pa]
    constexpr double by_points = 1e-3;  // what points of other cells add where bodies meet
    constexpr double by_lines = 5e-3;   // K0 σ_yy is quadratic in y, and read by a line through the points around
    CHECK(scenes::probe(s, "above", "stress.yy") == Approx(of_above).epsilon(by_points));
    CHECK(scenes::probe(s, "middle", "stress.yy") == Approx(of_middle).epsilon(by_points));
    for (const std::string across : {"stress.xx", "stress.zz"}) {
      CAPTURE(across);
      CHECK(scenes::probe(s, "above", across) == Approx((0.3 + 0.45) * of_above).epsilon(by_lines));
      CHECK(scenes::probe(s, "middle", across) == Approx((0.3 + 0.35) * of_middle).epsilon(by_lines));
    }
    CHECK(scenes::probe(s, "top", "u.y") == Approx(-43e3 * 3 / 1e7).epsilon(0.01));  // 1.3 % of strain: its square
  }
}

TEST_CASE("a static solver finds the equilibrium of a stage that takes strength away, as a motion does") {
  const auto weakened = [](const std::vector<std::string>& more) {
    Summary s = scenes::run_text(slope_of_one_point_a_cell,
                                 with({"stage=[{at=1, change=['base', 'slope'], material=['weak', 'weak'], "
                                       "equilibrium=true}]"},
                                      more));
    CAPTURE(more, s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    return scenes::probe(s, "crest", "u.y");
  };
  const double settled = weakened({});
  CHECK(settled < 0);
  CHECK(settled == Approx(weakened({"phase.dilatation=cells"})).epsilon(1e-3));
  CHECK(settled == Approx(weakened({"solve.method=relaxation"})).epsilon(0.02));
}

TEST_CASE("a body placed with a K0 beyond its strength begins with the stress that its law allows") {
  const auto placed = [](const std::string& dilatation) {
    Summary s =
        scenes::run_text(slope_of_one_point_a_cell, {"body[1].material=weak", "phase.dilatation=" + dilatation,
                                                     "stage=[{at=1, add=['slope'], K0='6', equilibrium=true}]"});
    CAPTURE(dilatation, s.reason);
    CHECK(s.status == RunStatus::equilibrium);
    return scenes::probe(s, "crest", "u.x");
  };
  CHECK(placed("points") == Approx(placed("cells")).epsilon(0.01));  // half as much again from a stress beyond it
}

TEST_CASE("a stage that waits for equilibrium ends when it has come, and later stages begin then") {
  const Summary s = run(cut("{at=0, equilibrium=true}, {at=0.01, remove=['above']}",
                            with(waiting, {"damping.strategy=viscous", "stop.time=100"})));
  CHECK(s.status == RunStatus::equilibrium);
  REQUIRE(s.stages.size() == 1);
  CHECK(s.stages[0].status == RunStatus::equilibrium);
  CHECK(s.stages[0].end > 0.01);
  CHECK(s.stages[0].residual <= 1e-7);
  const Summary hasty = run(cut("{at=0.01, remove=['above']}", with(waiting, {"stop.time=100"})));
  CHECK(hasty.stages.at(0).status == RunStatus::end_time);
  CHECK(hasty.stages.at(0).end == 0.01);
}

TEST_CASE("a run of stages has the same bits for any number of threads") {
  const auto figures = [](int threads) {
    const Summary s =
        run(scenes::load("ladder/lifts", with(waiting, {"material.fill.law=drucker-prager", "material.fill.c=1e5",
                                                        "damping.strategy=cundall"})),
            {.threads = threads});
    std::string all = fmt::format("{} {:a}", s.steps, s.residual);
    for (int k = 1; k <= 6; ++k) all += fmt::format(" {:a}", scenes::probe(s, fmt::format("lift {}", k), "u.y"));
    return all;
  };
  CHECK(figures(1) == figures(2));
}

TEST_CASE("a static solver finds each stage in equilibrium under the loads of its end, though they change afterwards") {
  const Summary s = run(scenes::load(
      "ladder/lifts",
      {"body=[{name='ground', max=['h', '3*h'], material='fill', state='plane-strain'}]", "stage=[{at=1}]",
       "stop.time=2", "body_force.value=[0, 0]", "traction=[{line=[[0, '3*h'], ['h', '3*h']], value=[0, '-1e3*t']}]",
       "probe=[{name='deep', at=['h/2', 'h/2'], fields=['stress.yy']}]"}));
  CAPTURE(s.reason);
  REQUIRE(s.status == RunStatus::equilibrium);
  CHECK(scenes::probe(s, "deep", "stress.yy") == Approx(-2e3).epsilon(1e-4));  // small strains
}

TEST_CASE("a strength by place that a later stage's body cannot have is refused before the first stage") {
  for (const std::string wrong : {"material.fill.rho='1000*(2.5*h - y)'", "material.fill.E='1e6*(4.5*h - y)'"}) {
    CAPTURE(wrong);
    CHECK_THROWS_WITH(Simulation(scenes::load("ladder/lifts", {wrong})), Catch::Contains("must be > 0 everywhere"));
  }
}
