// The combinations that a comparison tries, and the scene of each.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "linalg/multigrid.hpp"
#include "scenes.hpp"
#include "study/compare_candidates.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;
using Words = std::vector<std::string>;

namespace {

Words labels(const CompareOptions& options, const Problem& problem, bool transient = false) {
  Words found;
  for (const Candidate& candidate : candidates(options, problem, transient)) found.push_back(candidate.run.label());
  return found;
}

}  // namespace

TEST_CASE("each strategy that takes a step is tried by each integrator at each share or tolerance, others once") {
  const Scene scene = scenes::bar();
  CHECK(labels({.integrators = {"leapfrog", "erk:bogacki-shampine-4-2-3:adaptive"},
                .strategies = {"viscous", "kinetic", "newton", "chebyshev"},
                .step_fractions = {0.5, 0.9},
                .tolerances = {1e-3, 1e-6}},
               scene) == Words{"viscous 0.5", "viscous 0.9", "viscous, erk:bogacki-shampine-4-2-3 rtol 0.001",
                               "viscous, erk:bogacki-shampine-4-2-3 rtol 1e-06", "kinetic 0.5", "kinetic 0.9",
                               "kinetic, erk:bogacki-shampine-4-2-3 rtol 0.001",
                               "kinetic, erk:bogacki-shampine-4-2-3 rtol 1e-06", "newton", "chebyshev"});
}

TEST_CASE("without names every strategy that does something is tried by leapfrog, and viscous damping by others too") {
  const Words all = labels({}, scenes::bar());
  for (const std::string strategy : {"viscous 0.9", "cundall 0.9", "auto", "newton", "viscous, erk:rk4 0.9"}) {
    CAPTURE(strategy);
    CHECK(std::ranges::count(all, strategy) == 1);
  }
  for (const std::string label : {"none 0.9", "cundall, erk:rk4 0.9"}) {
    CAPTURE(label);
    CHECK(std::ranges::count(all, label) == 0);
  }
  if (!multigrid_is_missing().empty()) return;
  const auto found = candidates({}, scenes::bar(), false);
  for (const Candidate& candidate : found) CHECK(candidate.is_extra == (candidate.run.mass == "multigrid"));
  CHECK(std::ranges::count(all, "newton-cg:multigrid") == 1);
  CHECK(std::ranges::count(all, "newton:multigrid") == 0);  // it factorises
}

TEST_CASE("a transient is tried with the scene's own damping alone, and never by a static solver") {
  const Scene scene = scenes::bar({"damping.strategy=cundall", "stop.residual=0", "stop.time=1"});
  for (const Candidate& candidate : candidates({}, scene, true)) {
    CHECK(candidate.run.strategy == "cundall");
    CHECK_FALSE(candidate.is_newton);
  }
  CHECK_THROWS_WITH(candidates({.strategies = {"newton"}}, scene, true),
                    Contains("a static solution has no transient"));
}

TEST_CASE("the scene of a row has its strategy and step, and no number that belonged to another") {
  const Scene scene = scenes::bar({"damping.strategy=viscous", "damping.c=0.45", "integrator.step=0.01"});
  ComparedRun row;
  row.strategy = "identity", row.integrator = "leapfrog", row.step_fraction = 0.5;
  const Scene identity = scene_of(row, scene);
  CHECK(identity.damping.strategy == "identity");
  CHECK_FALSE(identity.damping.c);
  CHECK_FALSE(identity.integrator.step);
  CHECK(identity.integrator.step_fraction == 0.5);
  row.strategy = "viscous";
  CHECK(scene_of(row, scene).damping.c == 0.45);
  row.strategy = "newton-cg";
  CHECK(scene_of(row, scene).solve.method == "newton-cg");
  if (!multigrid_is_missing().empty()) return;
  row.mass = "multigrid";
  CHECK(scene_of(row, scenes::load("column", {"phase.max_motion=none"})).mass.kind == MassKind::multigrid);
}

TEST_CASE("a row's label has what sets it apart, and its evaluations are over those of the Chebyshev estimate") {
  ComparedRun row;
  row.strategy = "viscous", row.integrator = "leapfrog", row.evaluations = 300;
  CHECK(row.label() == "viscous");
  row.mass = "multigrid", row.integrator = "erk:rk4", row.step_fraction = 0.25;
  CHECK(row.label() == "viscous:multigrid, erk:rk4 0.25");
  CHECK(chebyshev_estimate(1e4, 2e-6) == Approx(50 * std::log(1e6)));
  Comparison comparison;
  CHECK_FALSE(comparison.over_chebyshev_estimate(row));
  comparison.chebyshev_estimate = 200;
  CHECK(comparison.over_chebyshev_estimate(row) == 1.5);
  row.evaluations = 0;
  CHECK_FALSE(comparison.over_chebyshev_estimate(row));
}
