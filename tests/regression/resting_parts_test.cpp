// Parts that rest while others move (phase.rest): the same motion for less work, and what is pushed moves again.
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;
using stillpoint::test::TemporaryFolder;

namespace {

const std::vector<std::string> small_slope = {"grid.cells=[40,22]", "output.every=0.5", "output.stages=[]"};

std::vector<std::string> with(std::vector<std::string> overrides, const std::vector<std::string>& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

struct Run {
  Summary summary;
  std::vector<double> t, wall, back;  // thrusts [N/m]
};
Run run_slope(const std::vector<std::string>& overrides, int threads = 1) {
  const TemporaryFolder folder;
  Run of;
  of.summary = run(scenes::load("slope", overrides), {.out = folder.path(), .threads = threads});
  const auto history = stillpoint::test::columns_of(folder.path() / "history.csv");
  of.t = history.at("t");
  of.wall = history.at("wall.normal");
  of.back = history.at("back.normal");
  return of;
}

double mean_between(const Run& run, const std::vector<double>& values, double begin, double end) {
  double sum = 0;
  int rows = 0;
  for (std::size_t k = 0; k < run.t.size(); ++k) {
    if (run.t[k] < begin || run.t[k] > end) continue;
    sum += values[k];
    ++rows;
  }
  return sum / rows;
}

}  // namespace

TEST_CASE(
    "soil that rests while a slope forms changes the work of the wall by no more than 2 %, and its thrust by no more "
    "than 5") {
  const std::vector<std::string> to_20_s = with(small_slope, {"stop.time=20"});
  const Run all = run_slope(to_20_s), resting = run_slope(with(to_20_s, {"phase.rest=0.01"}));
  REQUIRE(resting.summary.status == RunStatus::end_time);
  CHECK_FALSE(all.summary.resting_points);
  REQUIRE(resting.summary.resting_points);
  REQUIRE(resting.summary.held_force);
  CHECK(*resting.summary.resting_points > 0.05);  // half of the points at t = 20, hardly any in the beginning
  CHECK(*resting.summary.resting_points < 0.9);
  CHECK(*resting.summary.held_force > 0);
  CHECK(*resting.summary.held_force < 0.2);
  CHECK(*resting.summary.external_work == Approx(*all.summary.external_work).epsilon(0.02));
  // The thrust of the wedge that flows shakes, and its mean differs by per cents from run to run.
  CHECK(mean_between(resting, resting.wall, 2, 20) == Approx(mean_between(all, all.wall, 2, 20)).epsilon(0.05));
  CHECK(mean_between(resting, resting.back, 2, 20) == Approx(mean_between(all, all.back, 2, 20)).epsilon(0.02));
  CHECK(*resting.summary.mass_error < 1e-12);
  CHECK(*resting.summary.momentum_error < 1e-12);
}

TEST_CASE("what rests moves again as soon as it is pushed") {
  // The wall goes out, stands, and comes in again from t = 6 on: what has come to rest behind it is pressed together.
  const std::vector<std::string> pushed =
      with(small_slope, {"wall[1].motion=0.05*min(t, 4) - 0.02*max(0, t - 6)", "stop.time=12"});
  const Run all = run_slope(pushed), resting = run_slope(with(pushed, {"phase.rest=0.01"}));
  CHECK(*resting.summary.resting_points > 0.005);
  const auto thrust = [](const Run& of, double begin, double end) { return mean_between(of, of.back, begin, end); };
  CHECK(thrust(all, 7, 9) > 2 * thrust(all, 2, 4));
  // Without the push being noticed within a phase the thrust comes 0.7 s late, which is 30 % here.
  CHECK(thrust(resting, 2, 4) == Approx(thrust(all, 2, 4)).epsilon(0.05));
  CHECK(thrust(resting, 6.5, 8) == Approx(thrust(all, 6.5, 8)).epsilon(0.1));
  CHECK(thrust(resting, 9, 12) == Approx(thrust(all, 9, 12)).epsilon(0.1));  // it shakes by a fifth
}

TEST_CASE("what rests keeps its place when the grid is given columns before the first one") {
  // The mirror image: the wall that the grid follows is on the left.
  const std::vector<std::string> to_10_s = with(small_slope, {"stop.time=10", "phase.rest=0.01"});
  const std::string walls = "wall=[{name='back', face='right'}, {name='wall', face='left', motion='-0.05*t'}]";
  const Run right = run_slope(with(to_10_s, {"wall[1].motion=0.05*t"})), left = run_slope(with(to_10_s, {walls}));
  // Lost places would let nothing rest, as the grid is given a column each third of a second.
  CHECK(*left.summary.resting_points > 0.01);
  CHECK(*left.summary.resting_points > 0.5 * *right.summary.resting_points);
  CHECK(mean_between(left, left.back, 2, 10) == Approx(mean_between(right, right.back, 2, 10)).epsilon(0.02));
}

TEST_CASE("what an axis of symmetry bears is not taken for what holds a part at rest") {
  const auto collapse = [](const std::string& supports) {
    return run(scenes::load("ladder/collapse", {"phase.rest=0.01", "body.state=axisymmetric",
                                                "damping={strategy='one-sided', alpha=0.2}", "support=" + supports}),
               {});
  };
  const Summary by_axis = collapse("[{face='bottom'}]");
  const Summary by_roller = collapse("[{face='bottom'}, {face='left', kind='roller'}]");  // there the same
  CHECK(*by_axis.resting_points > 0.01);
  CHECK(*by_axis.resting_points == Approx(*by_roller.resting_points).epsilon(1e-9));
  CHECK(*by_axis.held_force == Approx(*by_roller.held_force).epsilon(1e-6));
}

TEST_CASE("a run in which parts rest has the same bits for any number of threads") {
  const std::vector<std::string> fine = {"stop.time=2", "output.stages=[]", "phase.rest=0.02"};
  const Run one = run_slope(fine, 1), two = run_slope(fine, 2);
  CHECK(*one.summary.resting_points > 0.1);
  CHECK(one.wall == two.wall);
  CHECK(*one.summary.external_work == *two.summary.external_work);
  CHECK(*one.summary.held_force == *two.summary.held_force);
}

TEST_CASE("parts rest only in a motion that goes on until stop.time, in phases, with a lumped mass") {
  const auto refused = [](const std::string& override) {
    return scenes::refusal("slope", {"phase.rest=0.01", override});
  };
  CHECK(refused("stop.time=1").empty());
  CHECK_THAT(refused("stop.residual=1e-6"), Contains("phase.rest") && Contains("stop.time"));
  CHECK_THAT(refused("phase.max_motion='none'"), Contains("phase.rest") && Contains("phase.max_motion"));
  CHECK_THAT(refused("mass={kind='consistent'}"), Contains("phase.rest") && Contains("lumped"));
  CHECK_THAT(refused("phase.dilatation='cells'"), Contains("phase.rest") && Contains("dilatation"));
  CHECK_THAT(refused("phase.rest=1.5"), Contains("phase.rest"));
}
