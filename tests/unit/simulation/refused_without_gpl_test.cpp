// What a build without the libraries under the GPL says where a scene asks for what they bring.
#include <stillpoint/integrator.hpp>

#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "base/gpl.hpp"
#include "base/json.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

TEST_CASE("a stepper of GSL is refused at the key, and a multigrid mass as well, with what was left out of the build") {
  const auto left_out = Contains("built without the libraries under the GPL"), remedy = Contains("STILLPOINT_GPL=ON");
  CHECK_THROWS_WITH(scenes::load("bar", {"integrator.method=gsl:rk4"}),
                    Contains("integrator.method") && left_out && remedy);
  CHECK_THROWS_WITH(find_method("gsl:rk4"), left_out && remedy);
  CHECK_THROWS_WITH(Simulation(scenes::load("incompressible", {"mass.kind=multigrid", "damping.strategy=auto"})),
                    Contains("mass.kind") && left_out && remedy);
}

TEST_CASE("a word that is no stepper of GSL is unknown, as in any build") {
  CHECK_THROWS_WITH(scenes::load("bar", {"integrator.method=leapfrgo"}), Contains("leapfrog") && !Contains("GPL"));
}

TEST_CASE("the versions of a build without the libraries under the GPL name none of them, and its own says so") {
  for (const char* const library : {"gsl", "cholmod"}) CHECK_FALSE(versions_of_libraries().contains(library));
  CHECK_THAT(std::string(missing_without_gpl()), Contains("gsl:") && Contains("multigrid"));
}
