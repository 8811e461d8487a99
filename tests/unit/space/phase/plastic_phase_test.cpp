// Trial and commit of a phase whose points remember, and the same bits for any number of threads.
#include <stillpoint/stillpoint.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <omp.h>

#include "allocation_count.hpp"
#include "files.hpp"
#include "largest.hpp"
#include "random_values.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "statics.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::contents;
using stillpoint::test::TemporaryFolder;

namespace {

/// The slope before its wall moves, under geostatic stress.
Scene slope(const std::string& cells = "20,11", std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), {"constants.h=0.3", "grid.cells=[" + cells + "]"});
  return scenes::load("slope", overrides);
}

/// Displacements that make some points yield: strains of up to 1e-3 and more.
std::vector<double> force(const LagrangianPhase& phase, double t, const std::vector<double>& u) {
  std::vector<double> R(phase.size());
  REQUIRE(phase.internal_force(t, u, R, *phase.make_trial()));
  return R;
}
/// Stress and plastic strain as of the last commit.
std::vector<double> state(const LagrangianPhase& phase) {
  const std::size_t P = phase.points();
  std::vector<double> stress(4 * P), strain(P);
  phase.fields().point_stress(0, std::vector<double>(phase.size(), 0.0), stress);
  phase.fields().point_history("plastic_strain", strain);
  stress.insert(stress.end(), strain.begin(), strain.end());
  return stress;
}

}  // namespace

TEST_CASE("a trial of plastic points is repeatable to the bit and leaves what was committed alone") {
  const auto phase = make_phase(slope());
  const std::size_t n = phase->size();
  const auto small = test::random_values(n, 1e-4, 1), large = test::random_values(n, 1e-2, 2);
  const auto at_start = state(*phase);
  const auto first = force(*phase, 0.01, small);
  const auto elsewhere = force(*phase, 0.02, large);
  CHECK(first != elsewhere);
  CHECK(force(*phase, 0.01, small) == first);
  CHECK(state(*phase) == at_start);

  statics::commit(*phase, small, 0.01);
  const auto committed = state(*phase);
  CHECK(committed != at_start);
  CHECK(std::ranges::count_if(
            std::vector<double>(committed.end() - static_cast<std::ptrdiff_t>(phase->points()), committed.end()),
            [](double strain) { return strain > 0; }) > 10);
  const auto second = force(*phase, 0.02, large);
  CHECK(second != elsewhere);  // the path counts
  force(*phase, 0.03, test::random_values(n, 5e-3, 3));
  CHECK(force(*phase, 0.02, large) == second);
  CHECK(state(*phase) == committed);
  // Where it was committed, nothing has moved since: the stress is the committed one.
  const auto there = force(*phase, 0.01, small);
  for (std::size_t i = 0; i < n; ++i) CHECK(there[i] == Approx(first[i]).margin(1e-9 * 1800 * 9.81 * 3));
}

TEST_CASE("what is committed is the trial's last evaluation, whichever trial it was and whatever it held, to the bit") {
  const auto anew = make_phase(slope()), again = make_phase(slope());
  const auto trial = again->make_trial();
  std::vector<double> R(again->size());
  for (unsigned step = 1; step <= 3; ++step) {
    const auto u = test::random_values(anew->size(), 1e-3 * step, step);
    const double t = 0.01 * step;
    statics::commit(*anew, u, t);
    REQUIRE(again->internal_force(t, test::random_values(anew->size(), 1e-3, 7), R, *trial));
    REQUIRE(again->internal_force(t, u, R, *trial));
    force(*again, t, test::random_values(anew->size(), 1e-3, 8));  // in another trial
    again->commit(*trial);
    CHECK(state(*anew) == state(*again));
    CHECK(force(*anew, t + 0.01, u) == force(*again, t + 0.01, u));
  }
}

TEST_CASE("a trial of another phase, or one not evaluated since the last commit, is refused") {
  const auto phase = make_phase(slope()), other = make_phase(slope());
  const std::vector<double> u(phase->size(), 0.0);
  std::vector<double> R(phase->size());
  const std::vector<double> v = phase->initial_velocity(0);
  const auto trial = phase->make_trial(), of_other = other->make_trial();
  CHECK_THROWS_AS(phase->commit(*trial), std::logic_error);
  CHECK_THROWS_AS(phase->internal_force(0, u, R, *of_other), std::logic_error);
  REQUIRE(phase->internal_force(0, u, R, *trial));
  REQUIRE(other->internal_force(0, u, R, *of_other));
  CHECK_THROWS_AS(phase->commit(*of_other), std::logic_error);
  phase->commit(*trial);
  CHECK_THROWS_AS(phase->commit(*trial), std::logic_error);
  REQUIRE(phase->internal_force(0, u, R, *trial));
  phase->control().begin_next(0.1, u, v);
  CHECK_THROWS_AS(phase->commit(*trial), std::logic_error);
}

TEST_CASE("no phase ends before its initial velocity is known, nor in a scene of a single phase") {
  Scene scene = slope();
  const auto not_begun = make_phase(scene);
  const std::vector<double> rest(not_begun->size(), 0.0);
  CHECK_THROWS_AS(not_begun->control().begin_next(0.1, rest, rest), std::logic_error);
  not_begun->initial_velocity(0);
  CHECK_NOTHROW(not_begun->control().begin_next(0.1, rest, rest));

  scene.phase = {};
  const auto single = make_phase(scene);
  const std::vector<double> v = single->initial_velocity(0);
  CHECK_THROWS_AS(single->control().begin_next(0.1, v, v), std::logic_error);
}

TEST_CASE("a phase begins with the forces that its laws answer to no increment, softening or not") {
  const bool softens = GENERATE(false, true);
  CAPTURE(softens);
  std::vector<std::string> overrides = {"material.soil.c=2000"};
  if (softens) overrides.insert(overrides.end(), {"material.soil.c_residual=0", "material.soil.softening_strain=1e-3"});
  const auto phase = make_phase(slope("20,11", overrides));
  const double t = 0.01;
  phase->initial_velocity(0);
  const auto u = test::random_values(phase->size(), 2e-3, 1);
  statics::commit(*phase, u, t);
  phase->control().begin_next(t, u, std::vector<double>(phase->size(), 0.0));

  const std::vector<double> rest(phase->size(), 0.0);
  const auto at_start = state(*phase);
  const auto begun = force(*phase, t, rest), through_the_laws = force(*phase, t + 1e-9, rest);
  CHECK(largest_difference(begun, through_the_laws) < 1e-12 * largest_magnitude(begun));
  statics::commit(*phase, rest, t);
  CHECK((state(*phase) == at_start) == !softens);
}

TEST_CASE("the right-hand side of a plastic scene with walls and local damping allocates nothing") {
  const Model model = make_model(slope());
  RelaxationSystem system(*model.phase, *model.damping);
  std::vector<double> y = test::random_values(2 * model.phase->size(), 1e-4, 1), ydot(y.size());
  REQUIRE(system(0, y, ydot));
  const long before = test::allocation_count();
  const bool admissible = system(0.001, y, ydot);
  system.accept(0.001, y, true);
  const bool again = system(0.002, y, ydot);
  const long allocated = test::allocation_count() - before;
  CHECK(admissible);
  CHECK(again);
  CHECK(allocated == 0);
}

TEST_CASE("plastic forces and what they commit are the same bits for 1 and 2 threads") {
  const int before = omp_get_max_threads();
  std::vector<double> forces[2], states[2];
  for (int threads = 1; threads <= 2; ++threads) {
    omp_set_num_threads(threads);
    const auto phase = make_phase(slope("70,33"));
    REQUIRE(phase->points() > 8192);  // fewer are left to one thread
    statics::commit(*phase, test::random_values(phase->size(), 1e-4, 1), 0.01);
    forces[threads - 1] = force(*phase, 0.02, test::random_values(phase->size(), 1e-3, 2));
    states[threads - 1] = state(*phase);
  }
  omp_set_num_threads(before);
  CHECK(forces[0] == forces[1]);
  CHECK(states[0] == states[1]);
}

TEST_CASE("a slope writes the same history to the bit for 1 and 2 threads, over several phases") {
  const TemporaryFolder folder;
  const Scene scene = slope(
      "70,33", {"constants.h=0.1", "phase.max_motion=0.02", "stop.time=0.4", "output.every=0.04", "output.stages=[]"});
  std::vector<std::string> histories;
  for (int threads = 1; threads <= 2; ++threads) {
    const auto out = folder.path() / std::to_string(threads);
    const Summary s = run(scene, {.out = out, .threads = threads});
    REQUIRE(s.status == RunStatus::end_time);
    CHECK(s.points > 8192);
    CHECK(s.phases > 5);
    histories.push_back(contents(out / "history.csv"));
  }
  CHECK(histories[0] == histories[1]);
  CHECK(histories[0].size() > 1000);
}
