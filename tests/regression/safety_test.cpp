// Factors of safety beside bounds, and beside limit loads that are found in another way.
#include <stillpoint/safety.hpp>
#include <stillpoint/scene_error.hpp>

#include <algorithm>
#include <cmath>
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
