// What goes on from a checkpoint is the run that was not broken off.
#include <stillpoint/integrator.hpp>
#include <stillpoint/relaxation.hpp>

#include <csignal>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "child.hpp"
#include "files.hpp"
#include "linalg/multigrid.hpp"
#include "resumed_runs.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using scenes::with;
using stillpoint::test::contents;
using stillpoint::test::json_of;
using stillpoint::test::resumed;
using stillpoint::test::TemporaryFolder;
using stillpoint::test::unbroken;
namespace fs = std::filesystem;

namespace {

struct BrokenOff {
  const char* scene;
  std::vector<std::string> set;
};

// The process ends within a step, after some of them.
void break_off(const Scene& scene, const fs::path& out, long steps) {
  Simulation simulation(scene, {.out = out});
  while (!simulation.done() && simulation.steps() < steps) simulation.step();
}

void check_same_bits(const BrokenOff& one, long steps) {
  const Scene scene = scenes::load(one.scene, with({"checkpoint.every_steps=20"}, one.set));
  CAPTURE(one.scene, one.set);
  const TemporaryFolder folder;
  break_off(scene, folder.path(), steps);
  CHECK_FALSE(fs::exists(folder.path() / "summary.json"));
  CHECK((resumed(folder.path()) == unbroken(scene)));
}

const std::vector<std::string> few_steps = {"stop.steps=90", "output.every=0.003"};

/// Settings of lifts that swing for 1.2 s, of a fill with this law; more: further ones.
std::vector<std::string> swinging_lifts(const char* law, const std::vector<std::string>& more) {
  std::vector<std::string> settings = {std::string("material.fill.") + law, "solve.method=relaxation",
                                       "damping.strategy=cundall", "stop.time=1.2", "output.every=0.05"};
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

}  // namespace

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with every integrator") {
  for (const Method& method : methods()) {
    const std::vector<std::string> set = {"integrator.method=" + method.name, "stop.steps=90", "output.every=0.5"};
    if (method.fixed_step) check_same_bits({"bar", set}, 70);
    if (method.adaptive) check_same_bits({"bar", with(set, {"integrator.rtol=1e-5"})}, 70);
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with every damping") {
  for (const StrategyInfo& damping : dampings()) {
    for (const char* method : {"leapfrog", "symplectic-euler"}) {
      check_same_bits({"inclusion",
                       {"damping.strategy=" + std::string(damping.name), std::string("integrator.method=") + method,
                        "grid.cells=[8, 8]", "stop.steps=90"}},
                      70);
    }
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with every relaxation") {
  for (const RelaxationInfo& relaxation : relaxations()) {
    const std::string strategy = "damping.strategy=" + std::string(relaxation.about.name);
    check_same_bits({"inclusion", {strategy, "grid.cells=[8, 8]", "stop.steps=90"}}, 70);
    check_same_bits({"hard/fast_column", {strategy, "stop.steps=300"}}, 250);
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with clay whose step follows it") {
  const std::string pressure = "pressure='cell*(1 + 7*min(t/0.02, 1))'}";
  check_same_bits({"ladder/triaxial_clay",
                   {"support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                    "traction=[{face='right', " + pressure + ", {face='top', " + pressure + "]",
                    "phase.max_motion=0.05", "stop.time=0.03", "output.every=0.001"}},
                  150);
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one in any of its stages") {
  for (const char* law : {"law=linear-elastic", "law=hencky", "law=drucker-prager"}) {
    std::vector<std::string> set =
        swinging_lifts(law, {"stage=[{at=0.2, add=['b'], hold=['prop']}, {at=0.5, add=['c'], release=['prop']}, "
                             "{at=0.8, remove=['c']}]",
                             "body=[{name='a', max=['h', '2*h'], material='fill', state='plane-strain'}, {name='b', "
                             "min=[0, '2*h'], max=['h', '3*h'], material='fill'}, {name='c', min=[0, '3*h'], "
                             "max=['h', '5*h'], material='fill'}]",
                             "support=[{face='bottom', name='floor'}, {face='left', kind='roller'}, {face='right', "
                             "kind='roller'}, {name='prop', at=[0, 'h'], component='y'}]",
                             "probe=[{name='top', at=['h/2', '5*h'], fields=['u.y']}, {name='ground', at=['h/2', "
                             "'2*h'], fields=['u.y', 'stress.yy']}]"});
    for (const long steps : {60L, 120L, 200L, 300L}) check_same_bits({"ladder/lifts", set}, steps);
  }
  // At rest, and waiting for the time of the next stage: what told equilibrium is kept.
  check_same_bits({"ladder/lifts",
                   {"solve.method=relaxation", "damping.strategy=viscous", "stop.residual=1e-6", "output.every=0.1",
                    "stage=[{at=0, equilibrium=true}, {at=3, add=['lift 2', 'lift 3', 'lift 4', 'lift 5', 'lift 6'], "
                    "ramp=0.1}]"}},
                  700);
}

TEST_CASE(
    "a run that is broken off and resumed has the bits of the unbroken one in stages that loads begin and end with") {
  for (const char* law : {"law=linear-elastic", "law=hencky", "law=drucker-prager"}) {
    const std::vector<std::string> set = swinging_lifts(
        law, {"body=[{name='a', max=['h', '2*h'], material='fill', state='plane-strain'}, {name='b', min=[0, '2*h'], "
              "max=['h', '3*h'], material='fill'}]",
              "traction=[{name='surcharge', line=[[0, '3*h'], ['h', '3*h']], value=[0, -1e4]}]",
              "force=[{name='pile', at=['h/2', '3*h'], value=[0, -100]}, {at=['h/2', 'h'], value=[0, -200]}]",
              "stage=[{at=0.2, add=['b']}, {at=0.5, hold=['surcharge', 'pile']}, {at=0.8, release=['surcharge']}]",
              "support=[{face='bottom', name='floor'}, {face='left', kind='roller'}, {face='right', kind='roller'}]",
              "probe=[{name='ground', at=['h/2', '2*h'], fields=['u.y', 'stress.yy']}]"});
    for (const long steps : {60L, 150L, 200L, 300L}) check_same_bits({"ladder/lifts", set}, steps);
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one in stages with contact") {
  for (const char* law : {"law=linear-elastic", "law=hencky", "law=drucker-prager"}) {
    const std::vector<std::string> set = swinging_lifts(
        law, {"body=[{name='a', max=['h', '2*h'], material='fill', state='plane-strain'}, {name='b', min=[0, '2*h'], "
              "max=['h', '3*h'], material='fill'}, {name='c', min=[0, '3*h'], max=['h', '4*h'], material='fill'}]",
              "rigid=[{name='plate', half_plane=[[0, '4*h'], [0, -1]], motion=['0.01*t', '-0.02*t'], friction=0.3}, "
              "{name='footing', min=[0, '3*h'], max=['h', '5*h'], free=true, force=['0', '-2e4'], bodies=['b']}]",
              "contact=[{bodies=['c', 'b'], friction=0.4}]",
              "stage=[{at=0.2, add=['c', 'plate']}, {at=0.6, remove=['c', 'plate'], add=['footing']}]",
              "probe=[{name='ground', at=['h/2', '2*h'], fields=['u.y', 'stress.yy']}]"});
    for (const long steps : {60L, 150L, 250L}) check_same_bits({"ladder/lifts", set}, steps);
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with rigid bodies that touch it") {
  check_same_bits({"ladder/incline", {"rigid[0].friction=0.28", "stop.steps=90", "output.every=0.05"}}, 70);
  check_same_bits({"ladder/pressed_plate", {"damping.strategy=viscous", "checkpoint.every_steps=5"}}, 72);
  check_same_bits(
      {"sinking_footing",
       {"rigid[0].friction=0.3", "constants.T=2", "stop.steps=900", "checkpoint.every_steps=300", "output.every=0.1"}},
      700);
  // The border is cut anew before it is broken off, and after.
  check_same_bits({"ladder/cone_penetration",
                   {"grid.x=[[0.0, 4.0, 8], [4.0, 14.0, 6, 1.2]]", "grid.y=[[0.0, 6.0, 4], [6.0, 27.0, 42]]",
                    "rigid[0].friction=0.3", "constants.v=0.4", "stop.steps=1500", "checkpoint.every_steps=300",
                    "output.every=0.5"}},
                  1300);
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with bodies that touch each other") {
  check_same_bits({"ladder/stacked_blocks", {"damping.strategy=viscous", "stop.residual=1e-6"}}, 300);
  for (const char* quadrature : {"points", "domains"}) {
    check_same_bits({"hard/dragged_block",
                     {std::string("phase.quadrature=") + quadrature, "constants.v=1", "stop.time=1.4",
                      "output.every=0.1", "checkpoint.every_steps=300"}},
                    1700);
  }
  check_same_bits({"ladder/free_footing",
                   {"damping.strategy=one-sided", "material.soil.law=hencky", "phase.max_motion=0.02",
                    "stop.residual=0", "stop.steps=900", "checkpoint.every_steps=300", "output.every=0.05"}},
                  700);
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with the momentum of multigrid") {
  if (!multigrid_is_missing().empty()) return;
  for (const char* strategy : {"viscous", "kinetic", "adaptive", "chebyshev", "auto"}) {
    check_same_bits({"incompressible",
                     {"mass.kind=multigrid", std::string("damping.strategy=") + strategy, "stop.steps=30",
                      "checkpoint.every_steps=5"}},
                    12);
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with multigrid in a later phase") {
  if (!multigrid_is_missing().empty()) return;
  check_same_bits({"block",
                   {"mass.kind=multigrid", "damping.strategy=auto", "phase.max_motion=0.1", "grid.cells=[20,20]",
                    "stop.steps=40", "checkpoint.every_steps=3"}},
                  25);
  for (const long steps : {10L, 40L, 70L}) {
    check_same_bits({"ladder/lifts",
                     {"mass.kind=multigrid", "solve.method=relaxation", "damping.strategy=auto", "stop.residual=1e-8",
                      "material.fill.law=hencky", "checkpoint.every_steps=2",
                      "stage=[{at=0, equilibrium=true}, {at=1, add=['lift 2'], ramp=0, equilibrium=true}, {at=2, "
                      "add=['lift 3', 'lift 4', 'lift 5', 'lift 6'], ramp=0, equilibrium=true}]"}},
                    steps);
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with every static solver") {
  for (const char* solver : {"cg", "lbfgs", "newton", "newton-cg"}) {
    const std::string method = std::string("solve.method=") + solver;
    check_same_bits({"inclusion", {method, "grid.cells=[8, 8]"}}, 30);
  }
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one in phases, with whatever they hold") {
  const std::vector<std::string> small = {"grid.cells=[24, 10]", "stop.steps=150", "output.fields_every=0.005"};
  for (const char* transfer : {"flip", "pic", "xpic", "apic"})
    check_same_bits({"slope", with(small, {std::string("phase.transfer=") + transfer})}, 110);
  check_same_bits({"slope", {"grid.cells=[24, 10]", "stop.steps=500", "output.stages=[]", "phase.rest=0.05"}}, 410);
  for (const char* dilatation : {"cells", "splines"}) {
    check_same_bits({"slope", with(small, {"grid.basis=quadratic", std::string("phase.dilatation=") + dilatation})},
                    110);
  }
  for (const char* strategy : {"viscous", "kinetic", "auto"})
    check_same_bits({"hard/beam_in_phases", {std::string("damping.strategy=") + strategy, "stop.steps=400"}}, 290);
  check_same_bits({"hard/pulled_in_phases", {"stop.steps=400"}}, 290);
  check_same_bits(
      {"hard/pulled_in_phases", {"traction=[]", "force=[{at=[1.0, 0.5], value=[0.05, 0.0]}]", "stop.steps=400"}}, 290);
  for (const char* quadrature : {"domains", "points"}) {  // a pin and a part of a face, which springs hold
    check_same_bits({"hard/pulled_in_phases",
                     {"support=[{face='left', kind='roller', name='side'}, {at=[0.0, 0.45], component=1, name='pin', "
                      "u='0.01*min(t, 1)'}, {face='bottom', from=0.1, to=0.9, kind='roller'}]",
                      std::string("phase.quadrature=") + quadrature, "stop.steps=400"}},
                    290);
  }
  check_same_bits({"hard/fast_wall", {"stop.steps=400"}}, 290);
  const std::vector<std::string> slope_in_space = {"constants.W=0.6", "grid.cells=[12, 7, 3]", "stop.steps=150"};
  for (const char* basis : {"linear", "quadratic"})
    check_same_bits({"slope_in_space", with(slope_in_space, {std::string("grid.basis=") + basis})}, 110);
  // Places that move, and one in space.
  check_same_bits({"hard/free_flight",
                   {"stop.steps=400", "output.every=0.02",
                    "probe=[{name='tail', at=0.5, fields=['u', 'v', 'stress']}, {name='mid', at=1.3, fields=['u']}, "
                    "{name='gate', at=3.0, frame='space', fields=['v', 'stress']}]"}},
                  290);
  // Domains of several sizes, which change places on their way.
  check_same_bits({"hard/beam_in_phases", {"grid.cells=[13, 17]", "stop.steps=600"}}, 590);
  // Domains that are halved on their way.
  check_same_bits(
      {"hard/pulled_in_phases", {"constants.F=3", "grid.max=[6, 1]", "grid.cells=[24, 4]", "stop.steps=400"}}, 390);
}

TEST_CASE("a run that is broken off and resumed has the bits of the unbroken one with walls, and with what stiffens") {
  check_same_bits({"block_on_wall", {"stop.steps=150"}}, 90);
  check_same_bits({"neo_hookean_bar", {"stop.steps=150"}}, 90);
  check_same_bits({"footing", {"stop.steps=150"}}, 90);
  check_same_bits({"hard/yielding_ground", {}}, 50);
  check_same_bits({"hard/yielding_ground", {"phase.max_motion=1e-5"}}, 90);
  check_same_bits({"incompressible", {"stop.steps=150"}}, 90);
}

TEST_CASE("a run may be resumed again and again, and by another number of threads") {
  const Scene scene = scenes::load("block_on_wall", {"stop.steps=150", "checkpoint.every_steps=20"});
  const TemporaryFolder folder;
  break_off(scene, folder.path(), 50);
  for (const long steps : {70, 71, 130}) {
    const fs::path checkpoint = folder.path() / "checkpoint.h5";
    Simulation simulation(load_scene_of(checkpoint), {.out = folder.path(), .resume = checkpoint, .threads = 2});
    while (simulation.steps() < steps) simulation.step();
  }
  CHECK((resumed(folder.path()) == unbroken(scene)));
}

TEST_CASE("a program saves a state and goes on from it, with its own scene") {
  const TemporaryFolder folder;
  const fs::path checkpoint = folder.path() / "state.h5";
  const Scene scene = scenes::load("inclusion", {"grid.cells=[8, 8]"});
  Simulation first(scene);
  while (first.steps() < 30) first.step();
  first.save(checkpoint);
  Simulation second(scene, {.resume = checkpoint});
  CHECK(second.t() == first.t());
  while (first.steps() < 60) {
    first.step();
    second.step();
  }
  CHECK(std::ranges::equal(first.u(), second.u()));
  CHECK(std::ranges::equal(first.v(), second.v()));
  CHECK(first.evaluations() == second.evaluations());
}

TEST_CASE("the checkpoint before the last one is kept, and can be gone on from") {
  const Scene scene = scenes::load("block_on_wall", {"stop.steps=150", "checkpoint.every_steps=20"});
  const TemporaryFolder folder;
  break_off(scene, folder.path(), 90);
  const auto steps_of = [&](const char* name) { return Simulation(scene, {.resume = folder.path() / name}).steps(); };
  CHECK(steps_of("checkpoint.h5") == 80);
  CHECK(steps_of("checkpoint-previous.h5") == 60);
}

TEST_CASE("a history that was altered since the checkpoint is not appended to") {
  const Scene scene = scenes::load("block_on_wall", {"stop.steps=150", "checkpoint.every_steps=20"});
  const TemporaryFolder folder;
  break_off(scene, folder.path(), 90);
  const std::string history = contents(folder.path() / "history.csv.partial");
  folder.write("history.csv.partial", history.substr(0, 50));
  CHECK_THROWS_WITH(resumed(folder.path()), Catch::Contains("history.csv.partial: is not what was written so far"));
  folder.write("history.csv.partial", "T" + history.substr(1));
  CHECK_THROWS_WITH(resumed(folder.path()), Catch::Contains("history.csv.partial: was altered since it was written"));
}

TEST_CASE("SIGTERM and SIGHUP end the command in good order, and --resume goes on") {
  for (const int signal : {SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const std::string out = folder.path().string();
    test::Child child({"run", STILLPOINT_PROBLEMS "/bar.toml", "--set", "damping.strategy=none", "--set",
                       "stop.steps=400000", "--set", "checkpoint.every=60", "--quiet", "--out", out});
    CHECK(child.wait_until([&] { return fs::exists(folder.path() / "checkpoint.h5"); }));
    usleep(50'000);
    child.send(signal);
    CHECK(child.wait() == 3);
    CHECK(json_of(folder.path() / "summary.json")["status"] == "interrupted");
    const long steps = json_of(folder.path() / "summary.json")["steps"];
    CHECK(steps > 0);
    // By the folder, or by the file from inside it.
    const std::string command =
        signal == SIGTERM
            ? fmt::format("{} run --resume {} --quiet 2> {}/messages", STILLPOINT_BINARY, out, out)
            : fmt::format("cd {} && {} run --resume checkpoint.h5 --quiet 2> messages", out, STILLPOINT_BINARY);
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 3);
    CHECK(json_of(folder.path() / "summary.json")["status"] == "step-limit");
    CHECK(json_of(folder.path() / "summary.json")["steps"] == 400000);
  }
}
