// Factors of safety beside bounds, and beside limit loads that are found in another way.
#include <stillpoint/safety.hpp>
#include <stillpoint/scene_error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

namespace {

// A cut twice as heavy as it is cohesive, γ H = 2 c, that stands.
Scene cut_at_rest() {
  Scene scene = scenes::load("ladder/vertical_cut", {"material.clay.rho=2*c/(g*H)"});
  scene.load.reset();
  scene.solve.method = "newton";
  scene.stop = {};
  return scene;
}

// The verdicts in rising order: rests, then perhaps undecided, then moves.
void check_order(const SafetyStudy& study) {
  std::vector<SafetyTrial> trials = study.trials;
  std::ranges::sort(trials, {}, &SafetyTrial::factor);
  for (const SafetyTrial& trial : trials) {
    CAPTURE(trial.factor, to_string(trial.verdict), trial.reason);
    CHECK((trial.verdict == SafetyVerdict::rests) == (trial.factor <= study.factor_low));
    CHECK((trial.verdict == SafetyVerdict::moves) == (trial.factor >= study.factor_high));
    CHECK_FALSE(trial.reason.empty());
    if (trial.factor > study.trials.front().factor) CHECK(trial.displacement > 0);
  }
}

}  // namespace

TEST_CASE("Griffiths and Lane's slope has a factor of safety within 3 % of its bounds") {
  const SafetyStudy study = safety(scenes::load("stable_slope", {"grid.cells=[34, 11]"}), {.to = 2, .width = 0.02});
  REQUIRE(study.is_found());
  CHECK(*study.factor_high > 1.3656);        // rigorous lower bound
  CHECK(*study.factor_low < 1.03 * 1.4014);  // rigorous upper bound; cells of H/10 lock a little
  check_order(study);
  REQUIRE(study.mechanism);
  CHECK(study.mechanism->factor == study.factor_high);
  // What slides is between crest and toe: behind the crest nothing moves.
  double behind = 0, sliding = 0;
  const Mechanism& m = *study.mechanism;
  for (std::size_t p = 0; p < m.plastic_strain.size(); ++p) {
    const double x = m.positions[2 * p], way = std::hypot(m.displacement[2 * p], m.displacement[2 * p + 1]);
    (x < 4 ? behind : sliding) = std::max(x < 4 ? behind : sliding, way);
  }
  CHECK(behind < 0.4 * sliding);
}

TEST_CASE("a vertical cut falls at the factor at which its own weight, driven, makes it fall") {
  const SafetyStudy study = safety(cut_at_rest(), {.from = 1.5, .to = 2.5, .width = 0.04});
  REQUIRE(study.is_found());
  check_order(study);
  const double driven = 4.0718;  // of ladder/vertical_cut.toml, by relaxation and with Drucker–Prager's cone
  CHECK(2 * *study.factor_low < 1.01 * driven);
  CHECK(2 * *study.factor_high > 0.99 * driven);
}

TEST_CASE("a body that never comes to rest, one without strength and a wrong option are refused") {
  const auto refused = [](const Scene& scene, const SafetyOptions& options, const std::string& word) {
    CHECK_THROWS_WITH(safety(scene, options), Catch::Contains(word));
  };
  const std::string slope = "stable_slope";
  refused(scenes::load(slope, {"grid.cells=[34, 11]", "material.soil.c=1e3"}), {}, "does not come to an equilibrium");
  refused(scenes::load(slope, {"grid.cells=[34, 11]"}), {.from = 1.6, .to = 2}, "does not come to an equilibrium");
  refused(scenes::load(slope, {"grid.cells=[34, 11]"}), {.from = 1.5, .to = 2}, "rests only strained by");
  refused(scenes::load("column", {}), {}, "no material has a strength");
  refused(scenes::load("ladder/triaxial_clay", {}), {}, "the strength of 'cam-clay' has no name");
  refused(scenes::load(slope, {}), {.from = 0}, "from");
  refused(scenes::load(slope, {}), {.from = 2, .to = 2}, "to");
  refused(scenes::load(slope, {}), {.width = 0}, "width");
}

TEST_CASE("a slope that rests at every factor has no upper end, and the bracket is not found") {
  const SafetyStudy study = safety(scenes::load("stable_slope", {"grid.cells=[34, 11]"}), {.to = 1.2, .width = 0.1});
  CHECK(study.factor_low == 1.2);
  CHECK_FALSE(study.factor_high);
  CHECK_FALSE(study.is_found());
  CHECK_FALSE(study.mechanism);
}

TEST_CASE("a slope that is built in lifts, or dug, has the factor of safety of the slope") {
  const std::vector<std::string> slope = {"grid.cells=[34, 11]"};
  const SafetyOptions options{.from = 1.3, .to = 1.5, .width = 0.05};
  const std::string settings = "material='soil', state='plane-strain', points_per_cell=4, placement='gauss'}",
                    ground = "{name='ground', polygon=[[0, 0], [32, 0], [22, 5], [0, 5]], " + settings,
                    fill = "{name='fill', polygon=[[0, 5], [22, 5], [12, 10], [0, 10]], " + settings,
                    dug = "{name='dug', polygon=[[32, 0], [34, 0], [34, 10], [12, 10]], " + settings,
                    side = "{face='right', kind='roller', name='side'}",
                    others = "{face='bottom'}, {face='left', kind='roller'}";
  const auto factors_of = [&](std::vector<std::string> set) {
    set.insert(set.end(), slope.begin(), slope.end());
    const SafetyStudy study = safety(scenes::load("stable_slope", set), options);
    REQUIRE(study.is_found());
    return std::pair(*study.factor_low, *study.factor_high);
  };
  const auto at_once = factors_of({"body=[" + ground + ", " + fill + "]"});
  CHECK(factors_of({"body=[" + ground + ", " + fill + "]", "stage=[{at=1, add=['fill']}]"}) == at_once);
  CHECK(factors_of({"body=[" + ground + ", " + fill + ", " + dug + "]", "support=[" + others + ", " + side + "]",
                    "stage=[{at=1, remove=['dug'], release=['side']}]"}) == at_once);
}

TEST_CASE("a block that is squashed until it is wide enough for its load is not found at rest") {
  // Uniform: F = 2 c/p = 2, whatever the stiffness; a soft block has come to rest 25 % wider at 2.5.
  const Scene block = scenes::load("ladder/biaxial",
                                   {"grid={min=[0, 0], max=[2, 1.25], cells=[8, 5], basis='linear'}",
                                    "body={max=[1, 1], material='soil', state='plane-strain', points_per_cell=4}",
                                    "material={soil={law='drucker-prager', E=1e7, nu=0.3, rho=1, phi=0, c=1e5}}",
                                    "support=[{face='bottom', kind='roller'}, {face='left', kind='roller'}]",
                                    "traction=[{line=[[0, 1], [1, 1]], value=[0, -1e5]}]", "phase={max_motion='none'}",
                                    "solve={method='newton'}", "stop={residual=1e-6}", "probe=[]"});
  const SafetyStudy study = safety(block, {.to = 4, .width = 0.02});
  REQUIRE(study.factor_low);
  CHECK(*study.factor_low < 2 * 1.11);
  CHECK(*study.factor_low >= 1.98);
}

TEST_CASE("a layer of an infinite slope has the exact factor of safety, dilatant or not") {
  const std::vector<std::string> coarse = {"constants.n=8"};
  const double slope = std::tan(20 * std::acos(-1.0) / 180), associated = 0.2 + std::tan(std::acos(-1.0) / 6) / slope;
  const SafetyStudy dilatant = safety(scenes::load("ladder/sliding_layer", coarse), {.width = 0.02});
  const SafetyStudy isochoric = safety(
      scenes::load("ladder/sliding_layer", {"constants.n=8", "material.soil.psi=0", "constants.r=1"}), {.width = 0.02});
  REQUIRE(dilatant.is_found());
  REQUIRE(isochoric.is_found());
  // The points that yield lie a fifth of a cell above the base: 1 %
  CHECK((*dilatant.factor_low + *dilatant.factor_high) / 2 == Approx(associated).epsilon(0.015));
  CHECK((*isochoric.factor_low + *isochoric.factor_high) / 2 == Approx(1.6903787).epsilon(0.015));
}
