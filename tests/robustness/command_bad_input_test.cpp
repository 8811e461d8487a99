// The command on bad input: exit status 2, the reason on stderr, and no output folder.
#include <string>

#include <catch2/catch.hpp>

#include "broken_scene.hpp"
#include "command_run.hpp"

using stillpoint::test::broken;
using stillpoint::test::CommandRun;
using stillpoint::test::kGoodScene;

namespace {

void refuses(const CommandRun& run, const std::string& message) {
  CHECK(run.status == 2);
  CHECK_FALSE(run.wrote);
  CHECK_THAT(run.standard_error, Catch::Contains(message));
}

}  // namespace

TEST_CASE("the command refuses a wrong value at its place in the file, with status 2 and no output") {
  refuses({broken("rho = 1.0", "rho = 0"), "run SCENE --out OUT"},
          "scene.toml:13:7: material.steel.rho: must be greater than 0, not 0");
}

TEST_CASE("the command names a misspelt key's place and the key that was meant") {
  refuses({broken("strategy", "stratgey"), "run SCENE --out OUT"},
          "scene.toml:21:1: damping: unknown key 'stratgey'; did you mean 'strategy'?");
}

TEST_CASE("the command refuses a file that is not TOML at the place of the fault") {
  refuses({broken("cells = 4", "cells = "), "run SCENE --out OUT"}, "scene.toml:6:9: not valid TOML");
}

TEST_CASE("the command points into a wrong formula") {
  refuses({broken("\"P0\"", "\"2*P1\""), "run SCENE --out OUT"}, "scene.toml:19:12: force[0].value: unknown name 'P1'");
}

TEST_CASE("the command reports every problem of a scene in one run") {
  const CommandRun run(broken("c = 0.3", "c = -1", broken("cells = 4", "cells = 0")), "run SCENE --out OUT");
  refuses(run, "scene.toml:6:9: grid.cells");
  refuses(run, "scene.toml:22:5: damping.c");
}

TEST_CASE("the command shows a wrong override as it was typed") {
  refuses({kGoodScene, "run SCENE --out OUT --set damping.c=-1"}, "--set damping.c=-1: damping.c: must be at least 0");
  refuses({kGoodScene, "run SCENE --out OUT --set damping.c"}, "--set damping.c: expected key=value");
}

TEST_CASE("the command refuses a scene file that is not there, or is a folder") {
  refuses({kGoodScene, "run SCENE.none --out OUT"}, "scene.toml.none: there is no such file");
  refuses({kGoodScene, "run / --out OUT"}, "/: is a directory");
}

TEST_CASE("the command refuses an option that it does not know") {
  refuses({kGoodScene, "run SCENE --out OUT --mushroom"}, "--mushroom");
}

TEST_CASE("the command refuses a subcommand that it does not know") { refuses({kGoodScene, "rum SCENE"}, "rum"); }

TEST_CASE("copies that a launcher of MPI starts are refused by the first of them, before they write into one folder") {
  // As Open MPI, MPICH and Slurm tell a copy that it is one of two.
  for (const std::string by : {"OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=", "PMI_SIZE=2 PMI_RANK=",
                               "SLURM_STEP_NUM_TASKS=2 SLURM_PROCID="}) {
    INFO(by);
    for (const std::string command : {"run", "compare", "converge", "safety"})
      refuses({kGoodScene, command + " SCENE --out OUT", by + "0"}, "2 copies of this command");
    const CommandRun second(kGoodScene, "run SCENE --out OUT", by + "1");
    refuses(second, "");
    CHECK(second.standard_error.empty());
    CHECK(CommandRun(kGoodScene, "check SCENE", by + "0").status == 0);  // it writes nothing
  }
  CHECK(CommandRun(kGoodScene, "run SCENE --out OUT --quiet", "OMPI_COMM_WORLD_SIZE=1").status == 0);
}

TEST_CASE("list refuses a topic that it does not know, and a format of what is no key") {
  refuses({kGoodScene, "list kyes"}, "kyes");
  refuses({kGoodScene, "list keys --format yaml"}, "yaml");
  refuses({kGoodScene, "list bases --format schema"}, "--format schema: goes with the topic keys only");
  CHECK(CommandRun(kGoodScene, "list keys").status == 0);
}

TEST_CASE("the command refuses stop.distance if nothing bounds it, at its place in the file") {
  const std::string scene = broken("residual = 1e-6", "distance = 1e-4");
  refuses({broken("[[support]]\nat = 0.0\nu = 0.0\n", "", broken("\"P0\"", "0", scene)), "run SCENE --out OUT"},
          "scene.toml:24:12: a distance is bounded by omega_1");
  refuses({broken("[damping]", "[mass]\nkind = \"lumped\"\n[phase]\nmax_motion = 0.1\n[damping]",
                  broken("linear-elastic", "hencky", scene)),
           "run SCENE --out OUT"},
          "scene.toml:31:12: stop.distance: is certified for one set of unknowns");
}

TEST_CASE("compare refuses names that are none with status 2 and the one that was meant") {
  refuses({kGoodScene, "compare SCENE --out OUT --strategies viscous,viscuos"},
          "--strategies viscuos: there is no strategy 'viscuos'; did you mean 'viscous'?");
  refuses({kGoodScene, "compare SCENE --out OUT --strategies newtn"}, "did you mean 'newton'?");
  refuses({kGoodScene, "compare SCENE --out OUT --strategies mushroom"}, "expected one of none, viscous, identity");
  refuses({kGoodScene, "compare SCENE --out OUT --integrators leapfog"},
          "--integrators leapfog: there is no integrator 'leapfog'; did you mean 'leapfrog'?");
  refuses({kGoodScene, "compare SCENE --out OUT --integrators leapfrog:adaptive"},
          "--integrators leapfrog:adaptive: 'leapfrog' has no error estimate");
}

TEST_CASE("compare refuses combinations of which nothing is left") {
  refuses({kGoodScene, "compare SCENE --out OUT --strategies fire --integrators erk:rk4"},
          "--integrators erk:rk4: none of the strategies goes with these: fire");
  refuses({kGoodScene, "compare SCENE --out OUT --set stop.residual=0 --set stop.time=1 --strategies newton"},
          "--strategies newton: a static solution has no transient");
}

TEST_CASE("compare refuses scenes with nothing to compare with, each by its key") {
  refuses({broken("\"P0\"", "\"P0*min(t/10,1)\""), "compare SCENE --out OUT"},
          "scene.toml:28:8: loads or supports depend on t");
  refuses({broken("\"P0\"", "0"), "compare SCENE --out OUT"}, "nothing is displaced");
  refuses({broken("[damping]", "[mass]\nkind = \"lumped\"\n[phase]\nmax_motion = 0.1\n[damping]",
                  broken("[[force]]\nat = 10.0\nvalue = \"P0\"", "[body_force]\nvalue = 0.1",
                         broken("linear-elastic", "hencky"))),
           "compare SCENE --out OUT"},
          "in one phase; expected phase.max_motion");
}

TEST_CASE("compare refuses a wrong scene, numbers out of range and a folder that cannot be written") {
  refuses({broken("rho = 1.0", "rho = 0"), "compare SCENE --out OUT"}, "scene.toml:13:7: material.steel.rho");
  for (const std::string option : {"--goal 2", "--goal=-1", "--fractions 0.9,-1", "--repeats=-1", "--threads 0"}) {
    CAPTURE(option);
    CHECK(CommandRun(kGoodScene, "compare SCENE --out OUT " + option).status == 2);
  }
  refuses({kGoodScene, "compare SCENE --out /proc/nowhere"}, "--out /proc/nowhere: cannot be written");
}
