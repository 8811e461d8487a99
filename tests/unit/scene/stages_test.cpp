// The keys of [[stage]], and the scenes that stages make of a scene.
#include "scene/stages.hpp"

#include <stillpoint/scene_error.hpp>

#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "scene/controlled_loads.hpp"
#include "scenes.hpp"

using namespace stillpoint;

namespace {

std::string refusal(const std::string& stages, const std::vector<std::string>& more = {}) {
  std::vector<std::string> set = {"stage=[" + stages + "]"};
  set.insert(set.end(), more.begin(), more.end());
  return scenes::refusal("ladder/lifts", set);
}

std::vector<std::string> names(const std::vector<BodySpec>& bodies) {
  std::vector<std::string> all;
  for (const BodySpec& body : bodies) all.push_back(body.name);
  return all;
}

}  // namespace

TEST_CASE("a scene with stages is that of its first one, and each stage adds and takes away what it says") {
  Scene scene = scenes::load("ladder/lifts", {"stage=[{at=1, add=['lift 4']}, {at=3, remove=['lift 1', 'lift 4']}]"});
  CHECK(names(scene.bodies) == std::vector<std::string>{"lift 1", "lift 2", "lift 3", "lift 5", "lift 6"});
  CHECK(scene.phase.ends());
  CHECK(scene.location("body[3].min").line == scenes::load("ladder/lifts", {"stage=[]"}).location("body[4].min").line);
  begin_next_stage(scene);
  CHECK(names(scene.bodies) == std::vector<std::string>{"lift 1", "lift 2", "lift 3", "lift 5", "lift 6", "lift 4"});
  CHECK(scene.bodies.back().number == 3);
  CHECK(scene.location("body[5].min").line == scenes::load("ladder/lifts", {"stage=[]"}).location("body[3].min").line);
  begin_next_stage(scene);
  CHECK(names(scene.bodies) == std::vector<std::string>{"lift 2", "lift 3", "lift 5", "lift 6"});
  CHECK(scene.stages.empty());
  CHECK(scene.present_stage->at == 3);
}

TEST_CASE("rigid bodies come and go by the same names as bodies, and contacts may name bodies of any stage") {
  Scene scene = scenes::load(
      "ladder/lifts",
      {"stage=[{at=1, add=['lift 6', 'plate']}, {at=2, remove=['wall', 'lift 1']}, {at=3, remove=['plate']}]",
       "rigid=[{name='wall', half_plane=[[0, 0], [0, 1]], bodies=['lift 1']}, {name='plate', half_plane=[[0, 'H'], [0, "
       "-1]], bodies=['lift 6']}]",
       "contact=[{bodies=['lift 6', 'lift 5']}]"});
  REQUIRE(scene.rigid.size() == 1);
  CHECK(scene.rigid[0].name == "wall");
  CHECK(scene.rigid_as_written.size() == 2);
  begin_next_stage(scene);
  REQUIRE(scene.rigid.size() == 2);
  CHECK(scene.rigid[1].name == "plate");
  CHECK(scene.rigid[1].number == 1);
  begin_next_stage(scene);
  REQUIRE(scene.rigid.size() == 1);
  CHECK(scene.rigid[0].name == "plate");
  begin_next_stage(scene);
  CHECK(scene.rigid.empty());
}

TEST_CASE("rigid bodies and driven loads in stages that cannot be are refused by name") {
  const std::string plate = "rigid=[{name='plate', half_plane=[[0, 'H'], [0, -1]]}]";
  CHECK_THAT(refusal("{at=1, change=['plate'], material=['fill']}", {plate}),
             Catch::Contains("stage[0].change[0]: 'plate' is a rigid body, which has no material"));
  CHECK_THAT(refusal("{at=1, remove=['plate']}, {at=2, remove=['plate']}", {plate}),
             Catch::Contains("stage[1].remove[0]: rigid body 'plate' is not there then"));
  CHECK_THAT(refusal("{at=1, add=['lift 2']}", {"rigid=[{name='lift 2', half_plane=[[0, 'H'], [0, -1]]}]"}),
             Catch::Contains("stage[0].add[0]: a body and a rigid body have the name 'lift 2'"));
  CHECK_THAT(refusal("{at=1}", {"rigid=[{name='plate', half_plane=[[0, 'H'], [0, -1]], bodies=['lift 7']}]"}),
             Catch::Contains("there is no body 'lift 7'"));
  CHECK_THAT(refusal("{at=1}", {"solve.method=relaxation", "load={displacement='t', at=2}", "stop.time=4"}),
             Catch::Contains("load.at: must be the time of a [[stage]], and there is none at t = 2"));
}

TEST_CASE("a load that a stage holds stands aside until then, and one that a stage releases is gone from then on") {
  const std::string lifts = "add=['lift 2', 'lift 3', 'lift 4', 'lift 5', 'lift 6']";
  Scene scene = scenes::load(
      "ladder/lifts",
      {"stage=[{at=1, " + lifts + ", release=['early'], hold=['late', 'pile']}]",
       "traction=[{name='late', line=[[0, 'H'], ['h', 'H']], value=[0, -1]}, {name='early', line=[[0, 'h'], ['h', "
       "'h']], value=[0, -2]}]",
       "force=[{name='pile', at=['h/2', 'H'], value=[0, -3]}, {at=['h/2', 'h/2'], value=[0, -4]}]"});
  REQUIRE(scene.tractions.size() == 1);
  CHECK(scene.tractions[0].name == "early");
  CHECK(scene.tractions[0].number == 1);
  REQUIRE(scene.forces.size() == 1);
  CHECK(scene.forces[0].number == 1);
  CHECK(names_of_loads(scene) ==
        std::vector<std::string>{"traction[1]", "traction[0]", "force[1]", "force[0]", "body_force"});
  begin_next_stage(scene);
  REQUIRE(scene.tractions.size() == 1);
  CHECK(scene.tractions[0].name == "late");
  CHECK(scene.tractions[0].number == 0);
  REQUIRE(scene.forces.size() == 2);
  CHECK(scene.forces[0].number == 1);
  CHECK(scene.forces[1].name == "pile");
}

TEST_CASE("[load] drives loads by their numbers as they were written, whatever stands aside") {
  const Scene scene = scenes::load(
      "ladder/lifts", {"stage=[{at=1, add=['lift 2', 'lift 3', 'lift 4', 'lift 5', 'lift 6'], hold=['late']}]",
                       "traction=[{name='late', line=[[0, 'H'], ['h', 'H']], value=[0, -1]}, {line=[[0, 0], [0, 'h']], "
                       "value=[0, -2]}]",
                       "load={displacement='0.01*t', of=['traction[1]']}", "solve.method=relaxation", "stop.time=4"});
  REQUIRE(reference_loads(scene).tractions.size() == 1);
  CHECK(reference_loads(scene).tractions[0].number == 1);
  CHECK(without_reference_loads(scene).tractions.empty());
}

TEST_CASE("loads in stages that cannot be are refused by name, with what to do") {
  const std::string top = "traction=[{name='top', line=[[0, 'H'], ['h', 'H']], value=[0, -1]}]";
  const std::string unnamed = "traction=[{line=[[0, 'H'], ['h', 'H']], value=[0, -1]}]";
  const std::string lifted = "{at=1, add=['lift 5']}, {at=2, add=['lift 6']}";
  CHECK_THAT(refusal(lifted, {unnamed}),
             Catch::Contains("traction[0].line: lies on body 'lift 6', which is not there yet: the stage at t = 2 adds "
                             "it; give the load a name and list it in hold of that stage or of a later one"));
  CHECK_THAT(refusal(lifted, {"force=[{at=['h/2', 'H'], value=[0, -1]}]"}),
             Catch::Contains("force[0].at: lies on body 'lift 6', which is not there yet: the stage at t = 2 adds it; "
                             "give the load a name and list it in hold of that stage or of a later one"));
  CHECK_THAT(
      refusal("{at=1, hold=['top']}, {at=2, add=['lift 6']}", {top}),
      Catch::Contains("in the stage at t = 1: ") &&
          Catch::Contains("lies on body 'lift 6', which is not there yet: the stage at t = 2 adds it; list 'top' "
                          "in hold of that stage or of a later one"));
  const std::string on_fifth = "line=[[0, '5*h'], ['h', '5*h']], value=[0, -1]}]";
  CHECK_THAT(refusal("{at=1, add=['lift 6']}", {"traction=[{" + on_fifth}),
             Catch::Contains("touch here, so that nothing can load one of them; if the load ends with this stage, give "
                             "it a name and list that in its release"));
  CHECK(refusal("{at=1, add=['lift 6'], release=['fifth']}", {"traction=[{name='fifth', " + on_fifth}).empty());
  CHECK_THAT(refusal("{at=1, remove=['lift 6']}", {top}),
             Catch::Contains("no straight side of a box or a polygon holds both positions") &&
                 Catch::Contains("; if the load ends with this stage, list 'top' in its release"));
  CHECK_THAT(refusal("{at=1, remove=['lift 6']}", {"force=[{name='pile', at=['h/2', 'H'], value=[0, -1]}]"}),
             Catch::Contains("lies outside the bodies of this stage; if the load ends with this stage, list 'pile' in "
                             "its release"));
  CHECK_THAT(refusal("{at=1, hold=['lift 2']}"), Catch::Contains("'lift 2' is a body, which add and remove name"));
  CHECK_THAT(refusal("{at=1, hold=['top']}, {at=2, hold=['top']}", {top}),
             Catch::Contains("stage[1].hold[0]: load 'top' comes twice"));
  CHECK_THAT(refusal("{at=1, release=['top']}, {at=2, release=['top']}", {top}),
             Catch::Contains("stage[1].release[0]: load 'top' is not there then"));
  CHECK_THAT(refusal("{at=1}", {top, "support=[{face='bottom', name='top'}]"}),
             Catch::Contains("traction[0].name: there is a support 'top' already"));
  CHECK_THAT(refusal("{at=1, hold=['top']}", {top, "force=[{name='top', at=['h/2', 'h'], value=[0, -1]}]"}),
             Catch::Contains("force[0].name: there is a traction 'top' already"));
  CHECK_THAT(
      refusal("{at=1, hold=['top']}", {top, "solve.method=relaxation", "load={displacement='t'}", "stop.time=4"}),
      Catch::Contains("stage[0].hold[0]: load 'top' is one of those that [load] drives"));
}

TEST_CASE("elastic boxes that move on by phases represent domains in all stages, or in none if a later body cannot") {
  const auto quadrature = [](const std::vector<std::string>& more) {
    return scenes::load("ladder/lifts", scenes::with({"solve.method=relaxation", "damping.strategy=viscous",
                                                      "phase.max_motion=0.1", "material.fill.law=hencky"},
                                                     more))
        .phase.quadrature.value();
  };
  CHECK(quadrature({}) == Quadrature::domains);
  CHECK(quadrature({"phase.quadrature=points"}) == Quadrature::points);
  CHECK(quadrature({"phase.max_motion=none"}) == Quadrature::points);
  CHECK(quadrature({"body[4].placement=gauss"}) == Quadrature::points);
  const std::string soil = "material.soil={law='drucker-prager', E=1e7, nu=0.3, rho=1800, c=1e4, phi=30}";
  CHECK(quadrature({soil, "body[5].material=soil"}) == Quadrature::points);
  CHECK(quadrature({soil, "stage[4].change=['lift 1']", "stage[4].material=['soil']"}) == Quadrature::points);
}

TEST_CASE("a ramp is half of its stage, and an open last stage is as long as the one before") {
  const Scene open = scenes::load("ladder/lifts", {"solve.method=relaxation", "stage=[{at=1}, {at=3}, {at=3.5}]"});
  CHECK(open.stages[0].ramp == 1);
  CHECK(open.stages[1].ramp == 0.25);
  CHECK(open.stages[2].ramp == 0.25);
  const Scene ended =
      scenes::load("ladder/lifts", {"solve.method=relaxation", "stop.time=10", "stage=[{at=1, ramp=0}, {at=3}]"});
  CHECK(ended.stages[0].ramp == 0);
  CHECK(ended.stages[1].ramp == 3.5);
}

TEST_CASE("stages that cannot be are refused by name") {
  const std::vector<std::pair<std::string, std::string>> all = {
      {"{add=['lift 2']}", "the key 'at' is missing"},
      {"{at=-1}", "stage[0].at: must be at least 0, not -1"},
      {"{at=2}, {at=2}", "stage[1].at: must be later than 2, not 2"},
      {"{at=1, add=['lift 7']}", "there is no body 'lift 7'"},
      {"{at=1, add=['lift 2']}, {at=2, add=['lift 2']}", "body 'lift 2' comes twice"},
      {"{at=1, remove=['lift 2']}, {at=2, remove=['lift 2']}", "body 'lift 2' is not there then"},
      {"{at=1, remove=['lift 2']}, {at=2, add=['lift 2']}",
       "stage[0].remove[0]: body 'lift 2' comes with a later stage, and is not there before; what was taken away "
       "cannot come back"},
      {"{at=2, add=['lift 2']}, {at=1}", "must be later than 2, not 1"},
      {"{at=1, remove=['lift 2']}, {at=2, change=['lift 2'], material=['fill']}", "body 'lift 2' is not there then"},
      {"{at=1, change=['lift 2'], material=['fil']}", "there is no material 'fil'"},
      {"{at=1, change=['lift 2']}", "must be a material for each of the 1 bodies that change, not 0"},
      {"{at=1, change=['lift 2'], material=['fill']}", "'linear-elastic' is a law without history"},
      {"{at=1, change=['lift 2', 'lift 2'], material=['fill', 'fill']}",
       "body 'lift 2' changes twice at the same time"},
      {"{at=1, hold=['prop']}",
       "there is no support or load 'prop'; describe it in a table [[support]], [[traction]] or "
       "[[force]] with a name"},
      {"{at=1, ramp=1}", "stage[0].ramp: 'newton' is a static solver"},
      {"{at=0, add=['lift 2']}", "stage[0].add: at t = 0 there is what the scene has"},
      {"{at=1, add=['lift 2'], K0=0.5}",
       "stage[0].add[0]: the stress of 'linear-elastic', the law of 'lift 2', is 0 where nothing is deformed"},
      {"{at=1, remove=['lift 2'], K0=0.5}", "stage[0].K0: is of bodies that the stage adds, and it adds none"},
      {"{at=1, add=['lift 2'], K0=-0.5}", "stage[0].K0: must be greater than 0, not -0.5"},
      {"{at=1, equilibrium=1}", "stage[0].equilibrium: expected true or false"},
      {"{at=1, remove=['lift 1', 'lift 2', 'lift 3', 'lift 4', 'lift 5', 'lift 6']}", "no body is left then"},
  };
  for (const auto& [stages, message] : all) {
    CAPTURE(stages);
    CHECK_THAT(refusal(stages), Catch::Contains(message));
  }
  CHECK_THAT(refusal("{at=1}", {"stop.time=1"}), Catch::Contains("must be later than the last stage, at t = 1"));
  CHECK_THAT(refusal("{at=1, ramp=3}, {at=2}", {"solve.method=relaxation"}),
             Catch::Contains("stage[0].ramp: must be over when the next stage begins at t = 2"));
  CHECK_THAT(refusal("{at=1, equilibrium=true}, {at=2}", {"stop.residual=0", "stop.time=3", "solve.method=relaxation"}),
             Catch::Contains("there is no test of equilibrium: give stop.residual"));
  CHECK_THAT(refusal("{at=1, add=['lift 2'], K0=0.5}", {"body_force.value=[0, '-10*t']"}),
             Catch::Contains("body_force.value: must be constant and vertical, [0, b], if stage[0].K0 is asked for"));
  CHECK_THAT(refusal("{at=1, add=['lift 2']}",
                     {"material.fill={law='cam-clay', M=1, lambda=0.2, kappa=0.02, nu=0.3, rho=1800, e0=1, OCR=2}",
                      "initial.geostatic={K0=0.5, surface='H'}"}),
             Catch::Contains("give stage[0].K0, with which it bears its weight"));
  CHECK_THAT(refusal("{at=1}", {"grid.basis=hermite"}), Catch::Contains("'hermite' has no lumped mass"));
  CHECK_THAT(refusal("{at=1}", {"phase.max_motion=0.1", "solve.method=relaxation"}),
             Catch::Contains("is a law of small strain"));
  CHECK_THAT(refusal("{at=1}", {"probe=[{name='p', point=3, fields=['u.y']}]"}),
             Catch::Contains("points have other numbers in other stages; take at"));
}
