// [exact] solution: what of it is refused, and what is said.
#include <string>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "unit/exact/exact_checks.hpp"

using namespace stillpoint;
using Catch::Contains;
using exact_checks::refusal;

TEST_CASE("an exact solution that is not known is refused with the names of those that are") {
  CHECK_THAT(refusal("{solution='kirsh'}"), Contains("exact.solution") && Contains("did you mean 'kirsch'"));
  CHECK_THAT(refusal("{solution='airy'}"), Contains("lame-cylinder") && Contains("elastica"));
}

TEST_CASE("an exact solution has its own keys, each checked, and none of formulas") {
  CHECK_THAT(refusal("{solution='kirsch', tension_x=1}"), Contains("the key 'radius' is missing"));
  CHECK_THAT(refusal("{solution='kirsch', radius=-1, tension_x=1}"),
             Contains("exact.radius") && Contains("greater than 0"));
  CHECK_THAT(refusal("{solution='kirsch', radius=1, tensoin_x=1}"), Contains("tensoin_x") && Contains("tension_x"));
  CHECK_THAT(refusal("{solution='kirsch', radius=1}"), Contains("tension_x or tension_y"));
  CHECK_THAT(refusal("{solution='kirsch', radius=1, tension_x=1, u=['0', '0']}"),
             Contains("exact.u") && Contains("either formulas or solution"));
  CHECK_THAT(refusal("{radius=1, u=['0', '0']}"), Contains("unknown key 'radius'"));
  CHECK_THAT(refusal("{solution='lame-cylinder', inner_radius=2, outer_radius=1}"),
             Contains("exact.outer_radius") && Contains("greater than exact.inner_radius = 2"));
  CHECK_THAT(refusal("{solution='radial-mode', radius=1, amplitude=1, mode=1.5}"), Contains("exact.mode"));
  CHECK_THAT(refusal("{solution='radial-mode', radius=1, amplitude=1, edge='loose'}"), Contains("exact.edge"));
  CHECK_THAT(refusal("{solution='lame-cylinder', inner_radius=1, outer_radius=2, x0=1}", {"body.state=axisymmetric"}),
             Contains("exact.x0") && Contains("r = 0"));
}

TEST_CASE("an exact solution goes with its states and laws, one material and one phase") {
  const std::string hole = "{solution='kirsch', radius=1, tension_x=1}";
  CHECK(refusal(hole).empty());
  CHECK_THAT(refusal(hole, {"body.state=axisymmetric"}), Contains("no state 'axisymmetric'"));
  CHECK_THAT(refusal("{solution='vortex', inner_radius=1, outer_radius=2, angle=0.1}"),
             Contains("the law neo-hookean, not for 'linear-elastic'"));
  CHECK_THAT(
      refusal("{solution='column', height=1, g=1}",
              {"material.rubber={law='drucker-prager', E=2.0, nu=0.3, rho=1.5, phi=30, c=1}", "phase.max_motion=none"}),
      Contains("linear-elastic, hencky or neo-hookean"));
  CHECK_THAT(refusal(hole, {"material.rubber.law=hencky", "phase.max_motion=0.1"}),
             Contains("exact.solution") && Contains("undeformed positions"));
  CHECK_THAT(refusal(hole, {"body=[{material='rubber', max=[0.5, 1]}, {material='other', min=[0.5, 0]}]",
                            "material.other={law='hencky', E=1, rho=1}", "traction=[]"}),
             Contains("one material") && Contains("there are 2"));
}

TEST_CASE("a solution given by --set takes the place of the scene's formulas") {
  const Scene scene = scenes::load("cylinder", {"exact.solution=lame-cylinder", "exact.inner_radius=1",
                                                "exact.outer_radius=b", "exact.inner_pressure=p"});
  CHECK(scene.exact.u.empty());
  CHECK(scene.exact.parameters.at("outer_radius") == 2);
}
