// What supports bear: reactions in the summary and in the history, at rest and from phase to phase.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "elastic_block.hpp"
#include "files.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("the reaction of a support that prescribes unknowns is opposite to the loads, its own share of them too") {
  // Weight, a traction and a force, of which some act on the held nodes themselves; so small that a pressure's face
  // hardly turns.
  for (const char* basis : {"linear", "quadratic", "hermite"}) {
    for (const bool is_pressure : {false, true}) {
      const std::string side = is_pressure ? "{face='right', pressure=-1e-5}" : "{face='right', value=[1e-5, 0]}";
      const Summary s = solved({of(basis), "support=[{face='bottom', name='base'}]", "body_force.value=[2e-5, -1e-4]",
                                "traction=[" + side + "]", "force=[{at=[0.3, 0.02], value=[0, 5e-6]}]"});
      CAPTURE(basis, is_pressure, s.reactions.at("base"));
      const double turned = is_pressure ? 1e-8 : 1e-14;
      CHECK(std::abs(s.reactions.at("base")[0] + 3e-5) < turned);
      CHECK(std::abs(s.reactions.at("base")[1] - 9.5e-5) < turned);
    }
  }
  const Summary bar = run(scenes::bar({"support=[{at=0.0, name='end'}]", "stop.residual=1e-10"}));
  CHECK(bar.reactions.at("end")[0] == Approx(-0.001).epsilon(1e-9));
}

TEST_CASE("reactions are columns of the history, and the summary says them too") {
  const TemporaryFolder folder;
  run(block({kFooting, of("quadratic"), "solve.method=relaxation", "damping.strategy=viscous", "stop.residual=1e-6"}),
      {.out = folder.path()});
  CHECK_THAT(test::contents(folder.path() / "history.csv"),
             Catch::Contains(",base.reaction_x,base.reaction_y,footing.reaction_x,footing.reaction_y"));
  const auto json = test::json_of(folder.path() / "summary.json");
  CHECK(json["reactions"]["footing"]["y"].get<double>() ==
        Approx(-json["reactions"]["base"]["y"].get<double>()).epsilon(1e-5));
  CHECK(json["weak_supports"][0]["support"] == "support[1]");
  CHECK(json["weak_supports"][0]["gap"].get<double>() > 0);
  CHECK_THAT(json["notes"].dump(), Catch::Contains("support[1] 'footing' gives way by"));
}

TEST_CASE("a support that moves has the force that pulls the body, whatever the mass matrix, once it rests") {
  for (const char* mass : {"lumped", "consistent"}) {
    for (const char* stiffness : {"", ", stiffness=1e3"}) {
      const Summary s = run(block({of("quadratic"), std::string("mass.kind=") + mass, "solve.method=relaxation",
                                   "damping.strategy=viscous", "stop.residual=1e-9", "stop.time=100",
                                   std::string("support=[{face='bottom', name='base'}, {face='left', kind='roller'}, "
                                               "{face='top', kind='roller', name='lid', u='0.01*min(t/10, 1)'") +
                                       stiffness + "}]"}));
      CAPTURE(mass, stiffness, s.reason);
      REQUIRE(s.status == RunStatus::equilibrium);
      CHECK(s.reactions.at("lid")[1] > 0.009);  // pulls up
      CHECK(s.reactions.at("lid")[1] == Approx(-s.reactions.at("base")[1]).epsilon(1e-6));
    }
  }
}

TEST_CASE("from phase to phase a pin's force goes on, as do gap and reaction") {
  const Scene scene = scenes::load("hard/pulled_in_phases",
                                   {"support=[{face='left', kind='roller'}, {at=[0.0, 0.55], component=1, u='-0.1', "
                                    "name='pin'}]"});
  for (const char* quadrature : {"domains", "points"}) {
    Scene of_kind = scene;
    of_kind.phase.quadrature = std::string(quadrature) == "points" ? Quadrature::points : Quadrature::domains;
    const auto phase = make_phase(of_kind);
    std::vector<double> v = phase->initial_velocity(0);
    for (int change = 0; change < 4; ++change) {
      std::vector<double> u(phase->size()), R(u.size());
      for (std::size_t k = 0; k < u.size(); ++k) u[k] = 0.01 + 0.001 * std::sin(static_cast<double>(k));
      const auto before = phase->make_trial();
      REQUIRE(phase->internal_force(0.1, u, R, *before));
      const double gap = phase->supports().weak_supports(0.1, u)[0].gap;
      const double reaction = phase->supports().support_reactions(0.1, u, before->reactions)[0].force[1];
      v = phase->control().begin_next(0.1, u, std::vector<double>(u.size(), 0.0));
      const std::vector<double> rest(phase->size(), 0.0);
      R.resize(rest.size());
      const auto after = phase->make_trial();
      REQUIRE(phase->internal_force(0.1, rest, R, *after));
      CAPTURE(quadrature, change);
      CHECK(std::abs(reaction) > 1e-3);
      CHECK(phase->supports().weak_supports(0.1, rest)[0].gap == Approx(gap).epsilon(1e-12));
      CHECK(phase->supports().support_reactions(0.1, rest, after->reactions)[0].force[1] ==
            Approx(reaction).epsilon(1e-12));
    }
  }
}

TEST_CASE("a pin that moves takes the material along through many phases") {
  // The square moves along y as a whole, by 0.4 of its 1 m, through cells that were empty; at rest nothing is strained.
  const Summary s = run(scenes::load(
      "hard/pulled_in_phases",
      {"grid.max=[2, 2]", "grid.cells=[8, 8]", "traction=[]", "stop.time=200", "stop.residual=1e-6",
       "support=[{face='left', kind='roller'}, {at=[0.0, 0.55], component=1, u='0.4*min(t/50, 1)', name='pin'}]"}));
  CAPTURE(s.reason);
  CHECK(s.phases > 5);
  CHECK(s.weak_supports[0].gap < 1e-6);
  CHECK(scenes::probe(s, "corner", "u.y") == Approx(0.4).epsilon(5e-3));  // of the points, which keep a little strain
  CHECK(std::abs(scenes::probe(s, "corner", "u.x")) < 1e-3);
}

TEST_CASE("in phases the reactions of strong and weak supports balance the load") {
  const Summary s = run(scenes::load(
      "hard/pulled_in_phases", {"support=[{face='left', kind='roller', name='side'}, {at=[0.0, 0.5], component=1, "
                                "name='pin'}]"}));
  REQUIRE(s.status == RunStatus::equilibrium);
  const double q = 0.5 * (1.33 - 1 / 1.33);
  CHECK(s.phases > 5);
  CHECK(s.reactions.at("side")[0] == Approx(-q).epsilon(2e-6));  // the residual
  CHECK(std::abs(s.reactions.at("pin")[1]) < 1e-6 * q);
  CHECK(scenes::probe(s, "corner", "u.x") == Approx(0.33).epsilon(2e-3));
}
