// Who takes a mass whose inverse is a cycle of multigrid, who leaves it, and who is refused it.
#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "multigrid_runs.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

TEST_CASE(
    "auto takes a multigrid mass for a large linear body that leaves the mass open, says so, and not for a small") {
  REQUIRE_MULTIGRID();
  const auto model = [](const std::vector<std::string>& set) {
    std::vector<std::string> all = {"constants.nu=0.3", "grid.basis=linear", "damping.strategy=auto"};
    all.insert(all.end(), set.begin(), set.end());
    return make_model(scenes::load("incompressible", all));
  };
  const Model large = model({"grid.cells=[224,224]"});
  REQUIRE(large.multigrid);
  CHECK(std::ranges::any_of(large.notes, [](const std::string& n) { return n.starts_with("auto takes mass.kind"); }));
  CHECK_FALSE(model({"grid.cells=[64,64]"}).multigrid);
  CHECK_FALSE(model({"grid.cells=[224,224]", "mass.kind=lumped"}).multigrid);
  CHECK_FALSE(model({"grid.cells=[224,224]", "mass.scaling=gershgorin"}).multigrid);
  CHECK_FALSE(model({"grid.cells=[224,224]", "stop.residual=0", "stop.time=1"}).multigrid);
}

TEST_CASE(
    "auto takes a multigrid mass for a long beam that may turn, and not for a short one or where points remember") {
  REQUIRE_MULTIGRID();
  const auto takes = [](const std::vector<std::string>& set) {
    std::vector<std::string> all = {"grid.cells=[640,8]", "damping.strategy=auto"};
    all.insert(all.end(), set.begin(), set.end());
    return make_model(scenes::load("cantilever", all)).multigrid != nullptr;
  };
  CHECK(takes({}));
  CHECK_FALSE(takes({"grid.cells=[160,8]"}));
  CHECK_FALSE(takes({"material.beam={law='drucker-prager', E=12, nu=0, rho=1, phi=0, c=1}", "phase.max_motion=none"}));
  CHECK_FALSE(takes({"phase.max_motion=0.5"}));
}

TEST_CASE("auto keeps a lumped mass for a large linear body that its supports do not hold") {
  CHECK_FALSE(
      make_model(scenes::load("incompressible",
                              {"constants.nu=0.3", "grid.basis=linear", "grid.cells=[224,224]", "damping.strategy=auto",
                               "body_force.value=[-0.1,0.0]", "support=[{face='left', kind='roller'}]"}))
          .multigrid);
}

TEST_CASE(
    "critical damping with a multigrid mass keeps up with auto where volume is hardly lost, and a note says why") {
  REQUIRE_MULTIGRID();
  // ω₁ by the Ritz value that settles first took 13 times the evaluations of auto.
  const auto dilatation = GENERATE(as<std::string>(), "phase.dilatation=cells", "phase.dilatation=points");
  const auto run_by = [&](const char* strategy) {
    return run("incompressible", block(24, {"constants.nu=0.4999", dilatation, strategy}));
  };
  Simulation viscous = run_by("damping.strategy=viscous");
  const Simulation by_auto = run_by("damping.strategy=auto");
  CAPTURE(dilatation, by_auto.evaluations());
  CHECK(2 * viscous.evaluations() <= 5 * by_auto.evaluations());
  CHECK(std::ranges::any_of(viscous.summary().notes, [](const std::string& n) {
    return n.find("nearly incompressible") != std::string::npos && n.find("lambda/mu") != std::string::npos;
  }));
}

TEST_CASE("points that remember are refused a motion with a multigrid mass, and told what takes them") {
  REQUIRE_MULTIGRID();
  CHECK_THROWS_WITH(make_model(scenes::load("footing", {"mass.kind=multigrid"})),
                    Contains("mass.kind") && Contains("newton-cg"));
}

TEST_CASE(
    "a multigrid mass is refused with the reason where a motion means something, and where nothing can be done "
    "with an inverse") {
  const auto refusal = [](const std::vector<std::string>& set) {
    std::vector<std::string> all = {"mass.kind=multigrid"};
    all.insert(all.end(), set.begin(), set.end());
    return scenes::refusal("incompressible", all);
  };
  CHECK_THAT(refusal({"stop.residual=0", "stop.time=1"}), Contains("mass.kind") && Contains("fictitious inertia"));
  CHECK_THAT(refusal({"damping.strategy=one-sided"}), Contains("takes each by itself"));
  CHECK_THAT(refusal({"damping.strategy=fire"}), Contains("products with M"));
  CHECK_THAT(refusal({"damping.strategy=adaptive", "damping.quotient=diagonal"}), Contains("damping.quotient"));
  CHECK_THAT(refusal({"grid.basis=hermite"}), Contains("basis of values"));
  CHECK_THAT(refusal({"mass.scaling=gershgorin"}), Contains("needs mass.kind = \"lumped\""));
  CHECK(refusal({"damping.strategy=viscous"}).empty());
  CHECK_THAT(scenes::refusal("slope", {"mass.kind=multigrid"}), Contains("mass.kind"));
}
