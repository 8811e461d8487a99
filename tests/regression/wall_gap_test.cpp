// Where bodies lie beside walls and supports: a block on a smooth floor, above it, or above a face that is held.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;
using Catch::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double cell = 0.5;    // of all these grids [m]
constexpr double top = -0.002;  // −ρ g l²/(2 E) of a block on the floor [m]
constexpr double penetration = 1e-9 * cell;

using Settings = std::vector<std::string>;

/// A strategy; with viscous damping a rate near the critical one, since nothing holds the block.
std::string by(const std::string& strategy) {
  return "damping={strategy='" + strategy + (strategy == "viscous" ? "', c=25}" : "'}");
}

Scene on_floor(const std::string& strategy, Settings settings) {
  settings.insert(settings.end(), {by(strategy), "stop.residual=1e-9"});
  return scenes::load("hard/on_a_smooth_floor", settings);
}

std::string why_refused(const std::string& scene, const Settings& settings) {
  try {
    run(scenes::load(scene, settings));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("an elastic block comes to rest on a smooth floor where it belongs, whichever way it came there") {
  const std::vector<Settings> ways{
      {},
      {"body_force.value=[0, '-1 + 20*(t<0.5)']"},  // lifted for a while
      {"initial.v=[0, 5]"},                         // thrown up
      {"initial.u=[0, 0.1]"},                       // let fall
      {"initial.u=[0, -0.1]"},                      // pushed into the floor
      {"initial.u=[0, '0.05*(x - 1)']"},            // tilted
      {"initial.v=['0', '2*(x - 1)']"},             // turned over its edge
      {"body_force.value=[0, '-1 - 30*(t<0.2)']"},  // pressed, so that it jumps
  };
  for (const std::string strategy : {"auto", "viscous", "kinetic", "one-sided", "cundall", "adaptive"}) {
    for (const Settings& way : ways) {
      for (const char* basis : {"linear", "quadratic"}) {
        CAPTURE(strategy, way, basis);
        Settings settings = way;
        settings.push_back(std::string("grid.basis=") + basis);
        const Summary s = run(on_floor(strategy, settings));
        CAPTURE(s.reason);
        CHECK(s.status != RunStatus::diverged);
        CHECK_THAT(scenes::probe(s, "base", "u.y"), WithinAbs(0, penetration));
        const double share = s.status == RunStatus::equilibrium ? 1e-6 : 1e-3;  // what is left after 200 s without
        CHECK_THAT(scenes::probe(s, "top", "u.y"), WithinAbs(top, share * std::abs(top)));
      }
    }
  }
}

TEST_CASE("a wall is where its motion says, whether that is constant, begins elsewhere, jumps or comes back") {
  const std::vector<std::pair<std::string, double>> ways{
      {"0.1", 0.1},
      {"-0.1", -0.1},
      {"0.1*(t>=1)", 0.1},
      {"-0.1*(t>=1)", -0.1},
      {"0.05 + 0.05*min(t,1)", 0.1},
      {"0.2*min(t,1) - 0.1*min(max(t-2,0),1)", 0.1},
      {"0.1*(t<1)", 0},
  };
  for (const std::string strategy : {"auto", "viscous", "one-sided", "cundall", "adaptive"}) {
    for (const auto& [motion, end] : ways) {
      CAPTURE(strategy, motion);
      const Summary s = run(on_floor(strategy, {"wall[0].motion='" + motion + "'"}));
      CAPTURE(s.reason);
      CHECK_THAT(scenes::probe(s, "base", "u.y"), WithinAbs(end, penetration));
      const double share = 1e-3;  // of the displacement: not all are at rest after 200 s
      CHECK_THAT(scenes::probe(s, "top", "u.y") - end, WithinAbs(top, share * std::abs(top)));
    }
  }
}

TEST_CASE("in phases a wall that jumps takes an elastic body along to where it belongs, and says that it came later") {
  for (const char* motion : {"0.2", "0.2*(t>=1)", "-0.2*(t>=1)", "0.3*(t>=1) - 0.1*(t>=20)"}) {
    for (const char* basis : {"linear", "quadratic", "cubic"}) {
      for (const char* strategy : {"viscous", "auto", "cundall"}) {
        CAPTURE(motion, basis, strategy);
        const Summary s =
            run(on_floor(strategy, {"material.block.law=hencky", "phase.max_motion=0.1", "grid.follow=floor",
                                    std::string("wall[0].motion='") + motion + "'", std::string("grid.basis=") + basis,
                                    "body.min=[0,0]", "body.max=[4,2]",
                                    "support=[{face='left', kind='roller'}, "
                                    "{face='right', kind='roller'}]"}));
        CAPTURE(s.reason);
        CHECK(s.status == RunStatus::equilibrium);
        const double end = motion[0] == '-' ? -0.2 : 0.2;
        CHECK_THAT(scenes::probe(s, "base", "u.y"), WithinAbs(end, 2e-3 * cell));  // a place, which phases carry on
        CHECK_THAT(scenes::probe(s, "top", "u.y"), WithinAbs(end + top, 2e-3 * cell));
        CHECK(std::ranges::any_of(s.notes, [](const std::string& note) { return note.find("at once") != note.npos; }));
      }
    }
  }
}

TEST_CASE("a wall that comes to a body at rest from cells away, or goes and comes again, presses it in phases") {
  const std::vector<std::string> motions{
      "-(2 + s)*min(t/20, 1)",                                                                  // from four cells
      "-(2 + s)*(t>=1)",                                                                        // at once
      "-2*min(t/20, 1) + 0.9*min(max(0, t - 25)/10, 1) - (0.9 + s)*min(max(0, t - 45)/10, 1)",  // and again
  };
  for (const std::string& motion : motions) {
    for (const char* basis : {"linear", "quadratic", "cubic"}) {
      for (const char* strategy : {"one-sided", "auto", "viscous"}) {
        CAPTURE(motion, basis, strategy);
        const Summary s = run(
            scenes::load("hard/wall_that_comes", {"wall[0].motion='" + motion + "'", std::string("grid.basis=") + basis,
                                                  "body.points_per_cell=9", by(strategy)}));
        CAPTURE(s.reason);
        CHECK(s.status == RunStatus::equilibrium);
        CHECK_THAT(scenes::probe(s, "end", "u.x"), WithinAbs(-0.2, 2e-3 * cell));
        const double pressed = -1000 * std::log(0.9) / 0.9;
        CHECK_THAT(s.reactions.at("side").at(0), WithinRel(pressed, 0.02));
      }
    }
  }
}

TEST_CASE("what a wall has pushed out of itself by a good part of a cell is no equilibrium in phases") {
  const Summary s = run(on_floor("viscous", {"material.block.law=hencky", "phase.max_motion=0.3",
                                             "body.points_per_cell=9", "initial.u=[0, -0.2]"}));
  CHECK(s.exit_status == 3);
  CHECK_THAT(s.reason, Contains("0.4 cells") && Contains("floor"));
}

TEST_CASE("a body that falls in phases onto a face that is held lies on it from then on") {
  for (const auto& [basis, gap] :
       {std::pair{"linear", "1.2"}, std::pair{"quadratic", "1"}, std::pair{"cubic", "1.1"}}) {
    for (const char* strategy : {"one-sided", "fire2", "kinetic"}) {
      CAPTURE(basis, gap, strategy);
      const Summary s =
          run(scenes::load("hard/above_a_held_face",
                           {std::string("constants.gap=") + gap, by(strategy), std::string("grid.basis=") + basis,
                            "material.block.law=hencky", "phase.max_motion=0.3", "stop.residual=1e-6"}));
      CAPTURE(s.reason);
      CHECK(s.status == RunStatus::equilibrium);
      const double height = 3 - std::stod(gap), settled = 1e-3 * height * height / 2;
      CHECK_THAT(scenes::probe(s, "top", "u.y"), WithinAbs(-std::stod(gap) - settled, 5e-3 * cell));
    }
  }
}

TEST_CASE("a body that falls in phases comes to rest on the wall, neither above it nor beyond") {
  for (const char* gap : {"1", "0.4", "0.07", "1.23"}) {
    for (const char* basis : {"linear", "quadratic", "cubic"}) {
      for (const char* strategy : {"kinetic", "cundall"}) {
        CAPTURE(gap, basis, strategy);
        const Summary s = run(scenes::load(
            "hard/above_a_wall", {std::string("constants.gap=") + gap, by(strategy), std::string("grid.basis=") + basis,
                                  "material.block.law=hencky", "phase.max_motion=0.1"}));
        CAPTURE(s.reason);
        CHECK(s.status == RunStatus::equilibrium);
        const double height = 3 - std::stod(gap), settled = 1e-3 * height * height / 2;
        // What is left of a fall through many phases, in which points have stresses that no function feels.
        const double left = 2e-3 * cell;
        CHECK_THAT(scenes::probe(s, "top", "u.y"), WithinAbs(-std::stod(gap) - settled, left));
      }
    }
  }
}

TEST_CASE("in a single phase a body that does not lie on a wall is refused, with its distance") {
  for (const char* basis : {"linear", "quadratic", "cubic"}) {
    for (const auto& [gap, said] :
         {std::pair{"0.45", "0.45 m (0.9 of a cell)"}, std::pair{"0.5", "0.5 m (1 of a cell)"},
          std::pair{"1e-5", "1e-05 m (2e-05 of a cell)"}, std::pair{"1.3", "1.3 m (2.6 of a cell)"}}) {
      CAPTURE(basis, gap);
      CHECK_THAT(
          why_refused("hard/above_a_wall", {std::string("constants.gap=") + gap, std::string("grid.basis=") + basis}),
          Contains("the nearest body is " + std::string(said)) && Contains("phase.max_motion"));
    }
  }
  CHECK(why_refused("hard/above_a_wall", {"constants.gap=1e-9", "stop.steps=10"}).empty());  // what rounding leaves
}

TEST_CASE("a support on a face holds nothing across a gap, which is refused with its size") {
  for (const std::string support :
       {"{face='bottom'}", "{face='bottom', kind='roller'}", "{face='bottom', stiffness=10}"}) {
    for (const char* basis : {"linear", "quadratic", "cubic"}) {
      for (const std::string gap : {"0.01", "0.2", "0.45"}) {
        CAPTURE(support, basis, gap);
        const std::string said =
            why_refused("hard/above_a_held_face",
                        {"constants.gap=" + gap, std::string("grid.basis=") + basis,
                         "support=[{face='left', kind='roller'}, {face='right', kind='roller'}, " + support + "]"});
        if (Contains("stiffness").match(support)) {
          CHECK_THAT(said, Contains("no material reaches this support"));
        } else {
          CHECK_THAT(said, Contains("the nearest material is " + gap + " m"));
        }
      }
    }
  }
  CHECK(why_refused("hard/above_a_held_face", {"constants.gap=0", "stop.steps=10"}).empty());
}

TEST_CASE("of bodies that share functions across a gap one that is held along no axis of its load is refused") {
  const Settings rollers{"support=[{face='left'}, {face='bottom', kind='roller'}, {face='top', kind='roller'}]"};
  const std::string along_x = why_refused("hard/gap_between_blocks", rollers);
  CHECK_THAT(along_x, Contains("nothing holds it along x"));
}

TEST_CASE("of bodies that share functions across a gap the one that nothing else holds is refused") {
  for (const auto& [basis, gap] : {std::pair{"cubic", "1.1"}, std::pair{"quadratic", "0.6"},
                                   std::pair{"linear", "0.45"}, std::pair{"cubic", "0.02"}}) {
    CAPTURE(basis, gap);
    CHECK_THAT(why_refused("hard/gap_between_blocks",
                           {std::string("constants.gap=") + gap, std::string("grid.basis=") + basis}),
               Contains("nothing holds it") && Contains(std::string(gap) + " m"));
  }
}
