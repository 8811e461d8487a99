// Results are the same bits for any number of threads.
#include <catch2/catch.hpp>

#include "files.hpp"
#include "scenes.hpp"
#include "slab.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

struct Threaded {
  const char* scene;
  std::vector<std::string> set;
};

// What a run leaves behind, but for its times on the clock.
std::string left_by(const Scene& scene, int threads) {
  const TemporaryFolder folder;
  const Summary s = run(scene, {.out = folder.path(), .threads = threads});
  return fmt::format("{}\n{:a} {:a} {:a} {:a} {:a}\n{}", to_string(s.status), s.omega_1.value_or(0), s.omega_max,
                     s.c.value_or(0), s.residual, s.distance.value_or(0),
                     test::contents(folder.path() / "history.csv"));
}

void check_threads(const Scene& scene, std::initializer_list<int> numbers) {
  const std::string alone = left_by(scene, 1);
  for (const int threads : numbers) {
    CAPTURE(threads);
    CHECK((left_by(scene, threads) == alone));
  }
}

void check_threads(const Threaded& one, std::initializer_list<int> numbers) {
  CAPTURE(one.scene, one.set);
  check_threads(scenes::load(one.scene, one.set), numbers);
}

}  // namespace

TEST_CASE("every problem has the same history and the same frequencies for 1, 2, 3 and 8 threads") {
  const std::vector<Threaded> cases = {
      {"bar", {}},
      {"chain", {"stop.steps=200"}},
      {"block", {}},
      {"block_on_wall", {"stop.steps=200"}},
      {"cantilever", {"stop.steps=100"}},
      {"column", {}},
      {"cylinder", {"stop.steps=200"}},
      {"footing", {"stop.steps=200"}},
      {"inclusion", {"stop.steps=200"}},
      {"incompressible", {"stop.steps=200"}},
      {"level_ground", {"stop.steps=20"}},
      {"mms_bar", {"stop.steps=200"}},
      {"neo_hookean_bar", {"stop.steps=200"}},
      {"oedometer", {"grid.cells=[12, 12, 12]"}},  // 13 824 points, 9600 below: loops are threaded
      {"slope", {"grid.cells=[80, 32]", "stop.steps=20"}},
      {"sinking_footing", {"stop.steps=300"}},
      {"ladder/incline", {"rigid[0].friction=0.28", "stop.steps=300"}},
      {"ladder/triaxial_clay", {"grid.cells=[48, 40]", "stop.steps=60"}},
      {"slope", {"grid.cells=[80, 32]", "stop.steps=20", "grid.basis=quadratic", "phase.dilatation=splines"}},
  };
  for (const Threaded& one : cases) check_threads(one, {2, 3, 8});
}

TEST_CASE("soil in space behind a wall, in phases, has the same history for 1, 2, 3 and 8 threads") {
  check_threads(
      scenes::slab(scenes::load("slope", {"grid.cells=[80, 32]", "stop.steps=20", "phase.max_motion=0.001"}), 2),
      {2, 3, 8});
}

TEST_CASE("factors that are large enough for a threaded BLAS are the same bits for any number of threads") {
  const std::string large = "grid.cells=[60, 48]";
  check_threads({"incompressible", {large, "stop.steps=20"}}, {2, 3});
  check_threads({"incompressible", {large, "solve.method=newton", "damping={}"}}, {2, 3});
  check_threads({"footing", {"solve.method=newton", "damping={}"}}, {2, 3});  // unsymmetric: UMFPACK
}
