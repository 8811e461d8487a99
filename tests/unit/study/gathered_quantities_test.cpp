// What a study makes of its levels, of levels whose errors are given.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "scenes.hpp"
#include "study/level_run.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinRel;
using Values = std::vector<double>;

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
const Values sizes = {1, 0.5, 0.25, 0.125};

/// A study of four levels; fill(run, h) says what was read at the end of each.
ConvergenceStudy gathered(const Scene& scene, Refinement refinement,
                          const std::function<void(LevelRun& run, double h)>& fill) {
  ConvergenceStudy study;
  study.refined = {refinement};
  std::vector<LevelRun> runs;
  for (const double h : sizes) {
    LevelRun& run = runs.emplace_back();
    run.is_there = true;
    run.level.size = h;
    fill(run, h);
    study.levels.push_back(run.level);
  }
  gather_quantities(scene, runs, study);
  return study;
}

const StudiedQuantity& quantity(const ConvergenceStudy& study, const std::string& name) {
  const auto found = std::ranges::find(study.quantities, name, &StudiedQuantity::name);
  REQUIRE(found != study.quantities.end());
  return *found;
}

}  // namespace

TEST_CASE("norms against an exact solution keep their values, with the order that they have and that of the basis") {
  const Scene quadratic = scenes::load("column", {"grid.basis=quadratic"});
  const ConvergenceStudy study = gathered(quadratic, Refinement::h, [](LevelRun& run, double h) {
    run.norms = {{"u_l2", 0.1 * h * h * h}, {"stress_l2", 3 * h * h}};
    run.no_energy = "no moduli";
  });
  CHECK(study.reference == "the exact solution");
  const StudiedQuantity &u = quantity(study, "u_l2"), &stress = quantity(study, "stress_l2");
  CHECK(u.values == Values{0.1, 0.1 / 8, 0.1 / 64, 0.1 / 512});
  CHECK(u.errors == u.values);
  CHECK_THAT(u.order.value().order, WithinRel(3, 1e-12));
  CHECK_THAT(stress.order.value().order, WithinRel(2, 1e-12));
  CHECK(u.theory == 3.0);
  CHECK(stress.theory == 2.0);
  CHECK(study.notes == std::vector<std::string>{"u_energy is not reported: no moduli"});
}

TEST_CASE("where points stay the same the finest level is the reference, and orders are those of changes") {
  const ConvergenceStudy study = gathered(scenes::load("column"), Refinement::step, [](LevelRun& run, double h) {
    run.u = {3 + 4e-3 * h * h, 0, no_value, 4};  // two components at two points
    run.volume = {1, 2};
    run.norms = {{"u_l2", 7}};  // the error of space, which all levels share
  });
  CHECK(study.reference == "the finest level");
  const StudiedQuantity &l2 = quantity(study, "u_l2"), &most = quantity(study, "u_max");
  const double finest = 3 + 4e-3 / 64;
  for (std::size_t k = 0; k + 1 < sizes.size(); ++k) {
    const double moved = 4e-3 * (sizes[k] * sizes[k] - 1.0 / 64);
    CHECK_THAT(l2.values[k], WithinRel(moved / std::sqrt(finest * finest + 2 * 16), 1e-9));
    CHECK_THAT(most.values[k], WithinRel(moved / 4, 1e-9));
  }
  CHECK(std::isnan(l2.values.back()));
  CHECK_THAT(l2.order.value().order, WithinRel(2, 1e-4));
}

TEST_CASE("a probe whose value nobody knows is extrapolated to its limit, and its errors are against that") {
  const ConvergenceStudy study = gathered(scenes::load("column"), Refinement::points, [](LevelRun& run, double h) {
    run.probes = {{"top.u.y", -5 + 0.3 * h * h}};
    run.probe_errors = {no_value};
    run.u = {1}, run.volume = {1};
  });
  const StudiedQuantity& probe = quantity(study, "top.u.y");
  CHECK_THAT(probe.order.value().order, WithinRel(2, 1e-9));
  CHECK_THAT(probe.extrapolated.value(), WithinRel(-5, 1e-12));
  for (std::size_t k = 0; k < sizes.size(); ++k)
    CHECK_THAT(probe.errors[k], WithinRel(0.3 * sizes[k] * sizes[k], 1e-9));
}

TEST_CASE("a probe whose value is known has its errors against that, and no limit") {
  const ConvergenceStudy study = gathered(scenes::load("column"), Refinement::h, [](LevelRun& run, double h) {
    run.norms = {{"u_l2", h}};
    run.probes = {{"top.stress.yy", 1 + h}};
    run.probe_errors = {2 * h};
  });
  const StudiedQuantity& probe = quantity(study, "top.stress.yy");
  CHECK(probe.errors == Values{2, 1, 0.5, 0.25});
  CHECK_FALSE(probe.extrapolated);
  CHECK(probe.theory == 1.0);  // of stress on linear functions
}

TEST_CASE("levels whose error is what the solver has left are out of the order, and are named") {
  const ConvergenceStudy study = gathered(scenes::load("column"), Refinement::h, [](LevelRun& run, double h) {
    run.norms = {{"u_l2", h < 0.2 ? 2e-4 : 0.1 * h * h}};
    run.floor = 1e-3;
  });
  const ObservedOrder order = quantity(study, "u_l2").order.value();
  CHECK_THAT(order.order, WithinRel(2, 1e-12));
  CHECK(order.last == 2);
  REQUIRE(study.notes.size() == 1);
  CHECK_THAT(study.notes[0],
             Contains("u_l2: level 4 is left out of its order, as its errors are no more than the 1.0e-03"));
}

TEST_CASE("a study of which no level came to its end has no quantities, and one with nothing to look at says so") {
  const ConvergenceStudy failed =
      gathered(scenes::load("column"), Refinement::h, [](LevelRun& run, double) { run.is_there = false; });
  CHECK(failed.quantities.empty());
  CHECK(failed.notes.empty());
  const ConvergenceStudy nothing = gathered(scenes::bar(), Refinement::h, [](LevelRun&, double) {});
  CHECK(nothing.quantities.empty());
  CHECK_THAT(nothing.notes.back(), Contains("there is nothing to study"));
}

TEST_CASE("sources of error are compared by the first norm, or the first probe, or u itself") {
  LevelRun a, b;
  a.is_there = b.is_there = true;
  a.u = {1, 1}, b.u = {1, 3}, a.volume = b.volume = {1, 1};
  CHECK(figure_of_sources({Refinement::h}, a) == "u");
  CHECK_THAT(change("u", a, b), WithinRel(2 / std::sqrt(10.0), 1e-15));
  a.probes = {{"p.u", 4}}, b.probes = {{"p.u", 1}};
  CHECK(figure_of_sources({Refinement::h}, a) == "p.u");
  CHECK(change("p.u", a, b) == 3);
  a.norms = {{"u_max", 0.5}}, b.norms = {{"u_max", 0.75}};
  CHECK(figure_of_sources({Refinement::h}, a) == "u_max");
  CHECK(figure_of_sources({Refinement::step}, a) == "p.u");  // norms hold the error of space
  CHECK(change("u_max", a, b) == 0.25);
  CHECK(std::isnan(change("p.v", a, b)));
  b.is_there = false;
  CHECK(std::isnan(change("p.u", a, b)));
}
