// The program with the multigrid module, whose PETSc starts MPI, as one process among others.
#include <string>

#include <catch2/catch.hpp>

#include "command_run.hpp"
#include "linalg/multigrid.hpp"

namespace stillpoint::test {

// Those of several runs shared folders there, which the first to end took away from under the others.
TEST_CASE("a run with the multigrid mass needs no folder for temporary files") {
  if (!multigrid_is_missing().empty()) return;
  const CommandRun run(
      "", "run " STILLPOINT_PROBLEMS "/cantilever.toml --set mass.kind=multigrid --set damping.strategy=auto --out OUT",
      "TMPDIR=$PWD/scene.toml");
  CAPTURE(run.standard_error);
  CHECK(run.status == 0);
  CHECK(run.wrote);
}

}  // namespace stillpoint::test
