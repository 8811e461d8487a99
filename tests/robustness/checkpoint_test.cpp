// Checkpoints: what goes on from one is the run that was not broken off, and none that is not whole is gone on from.
#include <stillpoint/integrator.hpp>
#include <stillpoint/relaxation.hpp>

#include <cmath>
#include <csignal>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "base/checksum.hpp"
#include "child.hpp"
#include "files.hpp"
#include "output/checkpoint_file.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::contents;
using stillpoint::test::json_of;
using stillpoint::testing::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

struct Case {
  const char* scene;
  std::vector<std::string> set;
};

std::vector<std::string> with(std::vector<std::string> set, const std::vector<std::string>& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

// What a run leaves behind, but for its times on the clock.
std::string left_by(const Summary& s, const fs::path& out) {
  std::string left = fmt::format("{} {} steps {} evaluations {} phases {} rejected\n{:a} {:a} {:a} {:a} {:a}\n{}\n",
                                 s.reason, s.steps, s.rhs_evaluations, s.phases, s.rejected_steps, s.residual,
                                 s.distance.value_or(0), s.momentum_error.value_or(0), s.plastic_overshoot.value_or(-1),
                                 s.unbalanced_plastic_work.value_or(-1), fmt::join(s.notes, "\n"));
  for (const char* name : {"history.csv", "fields.h5", "fields.xdmf"})
    if (fs::exists(out / name)) left += contents(out / name);
  return left;
}

std::string unbroken(const Scene& scene) {
  const TemporaryFolder folder;
  const Summary s = run(scene, {.out = folder.path()});
  return left_by(s, folder.path());
}

// The process ends within a step, after some of them.
void break_off(const Scene& scene, const fs::path& out, long steps) {
  Simulation simulation(scene, {.out = out});
  while (!simulation.done() && simulation.steps() < steps) simulation.step();
}

std::string resumed(const fs::path& out) {
  const fs::path checkpoint = out / "checkpoint.h5";
  const Summary s = run(load_scene_of(checkpoint), {.out = out, .resume = checkpoint});
  return left_by(s, out);
}

void check_same_bits(const Case& one, long steps) {
  const Scene scene = scenes::load(one.scene, with(one.set, {"checkpoint.every_steps=20"}));
  CAPTURE(one.scene, one.set);
  const TemporaryFolder folder;
  break_off(scene, folder.path(), steps);
  CHECK_FALSE(fs::exists(folder.path() / "summary.json"));
  CHECK((resumed(folder.path()) == unbroken(scene)));
}

const std::vector<std::string> few_steps = {"stop.steps=90", "output.every=0.003"};

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
  for (const char* strategy : {"viscous", "kinetic", "auto"})
    check_same_bits({"hard/beam_in_phases", {std::string("damping.strategy=") + strategy, "stop.steps=400"}}, 290);
  check_same_bits({"hard/pulled_in_phases", {"stop.steps=400"}}, 290);
  check_same_bits(
      {"hard/pulled_in_phases", {"traction=[]", "force=[{at=[1.0, 0.5], value=[0.05, 0.0]}]", "stop.steps=400"}}, 290);
  check_same_bits({"hard/fast_wall", {"stop.steps=400"}}, 290);
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

TEST_CASE("a run that was interrupted goes on where it was, from the step of the interrupt") {
  const Scene scene =
      scenes::load("block_on_wall", {"stop.steps=150", "checkpoint.every_steps=1000", "output.stages=[1e-3, 1e3]"});
  const TemporaryFolder folder;
  int asked = 0;
  const Summary s = run(scene, {.out = folder.path(), .interrupted = [&] {
                                  return fs::exists(folder.path() / "history.csv.partial") && ++asked == 77;
                                }});
  CHECK(s.status == RunStatus::interrupted);
  CHECK(s.steps == 77);
  const fs::path checkpoint = folder.path() / "checkpoint.h5";
  CHECK(Simulation(load_scene_of(checkpoint), {.resume = checkpoint}).steps() == 77);
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

TEST_CASE("a checkpoint that is not whole is refused with what is wrong, and so is a foreign one") {
  const Scene scene = scenes::load("inclusion", {"grid.cells=[8, 8]"});
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  Simulation(scene).save(file);
  const std::string whole = contents(file);
  const auto refusal = [&](const std::string& bytes) {
    folder.write("checkpoint.h5", bytes);
    try {
      load_scene_of(file);
    } catch (const StateError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK(refusal(whole) == "taken");
  for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{600}})
    CHECK_THAT(refusal(whole.substr(0, size)), Catch::Contains("checkpoint.h5: is cut short: "));
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{511}})
    CHECK_THAT(refusal(whole.substr(0, size)), Catch::Contains("is no checkpoint of this format"));
  for (std::size_t at = 512; at < whole.size(); at += whole.size() / 97) {
    std::string altered = whole;
    altered[at] ^= 1;
    CHECK_THAT(refusal(altered), Catch::Contains("was altered"));
  }
  CHECK_THAT(refusal(whole + "x"), Catch::Contains("was altered"));
  CHECK_THAT(refusal("t,steps\n0,0\n" + std::string(600, '0')), Catch::Contains("is no checkpoint of this format"));
  CHECK_THROWS_WITH(load_scene_of(folder.path() / "none.h5"), Catch::Contains("none.h5: cannot be read"));
}

TEST_CASE("a checkpoint of another scene, other settings, another body or another version is refused") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  Simulation(scenes::load("inclusion", {"grid.cells=[8, 8]"})).save(file);
  const auto go_on = [&](const Scene& scene) { Simulation(scene, {.resume = file}); };
  CHECK_THROWS_WITH(go_on(scenes::bar()), Catch::Contains("it is of another scene than"));
  CHECK_THROWS_WITH(go_on(scenes::load("inclusion", {"grid.cells=[8, 9]"})),
                    Catch::Contains("it is of the scene with --set grid.cells=[8, 8], expected one with --set"));
  Scene moved = scenes::load("inclusion", {"grid.cells=[8, 8]"});
  moved.bodies.front().points_per_cell = {3, 3};
  CHECK_THROWS_WITH(go_on(moved), Catch::Contains("another body"));

  SavedState state = read_checkpoint(file);
  state["origin/version"] = "0.0.1";
  write_checkpoint(file, state);
  CHECK_THROWS_WITH(load_scene_of(file), Catch::Contains("it is of version 0.0.1, expected "));
}

TEST_CASE("a checkpoint that lacks a value, or has one of another kind or size, is refused with its name") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  const Scene scene = scenes::load("inclusion", {"grid.cells=[8, 8]"});
  Simulation(scene).save(file);
  const SavedState whole = read_checkpoint(file);
  for (const auto& [name, value] : whole) {
    CAPTURE(name);
    SavedState spoilt = whole;
    spoilt.erase(name);
    write_checkpoint(file, spoilt);
    CHECK_THROWS_WITH(Simulation(scene, {.resume = file}), Catch::Contains("it has no '" + name + "'"));
    spoilt[name] = std::holds_alternative<std::string>(value) ? SavedValue(std::vector<double>()) : SavedValue("?");
    write_checkpoint(file, spoilt);
    CHECK_THROWS_WITH(Simulation(scene, {.resume = file}), Catch::Contains("'" + name + "' is of another kind"));
  }
}

TEST_CASE("a checkpoint whose table is not that of its values is refused, whatever it asks for") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  const auto read = [&](const std::string& rest) {  // under a head that goes with it
    std::string head = fmt::format("Stillpoint checkpoint, format 2\nCRC-32 {:x} of the {} bytes after these 512\n",
                                   checksum(0, rest.data(), rest.size()), rest.size());
    head.resize(512, '\n');
    folder.write("checkpoint.h5", head + rest);
    return read_checkpoint(file);
  };
  const SavedState whole = read("text 539 2 a b\ntext 0 0 c\n\nhi!");
  REQUIRE(whole.size() == 2);
  CHECK(std::get<std::string>(whole.at("a b")) == "hi");
  CHECK(std::get<std::string>(whole.at("c")).empty());
  for (const char* table :
       {"text 520 9 a\n\n", "real 512 1000000000000 a\n\n", "real 512 2305843009213693953 a\n\n",
        "whole 512 18446744073709551617 a\n\n", "text 18446744073709551615 1 a\n\n", "text -1 1 a\n\n", "text 512 1",
        "text 512 1 a\ntext 512 1 a\n\n", "word 512 1 a\n\n", "real 512\n\n", "text 512 300 a\ntext 512 300 b\n\n"}) {
    CAPTURE(table);
    CHECK_THROWS_WITH(read(table), Catch::Contains("checkpoint.h5: cannot be read: its table is not that of"));
  }
}

TEST_CASE("a state with spoilt values is refused, or gone on from as far as that goes, and crashes nothing") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "checkpoint.h5";
  // Points that change cells beside a wall that they rub against.
  const Scene scene = scenes::load("slope", {"grid.cells=[8, 4]", "stop.steps=60", "phase.max_motion=0.001"});
  Simulation first(scene);
  while (first.steps() < 40) first.step();
  first.save(file);
  const SavedState whole = read_checkpoint(file);
  std::mt19937 random(1);
  const std::vector<double> hard = {0, -1, 1, 2, 1e300, -1e300, 1e9, -1e9, std::nan(""), HUGE_VAL, 255, 2147483648.0};
  int refused = 0;
  for (int k = 0; k < 400; ++k) {
    SavedState spoilt = whole;
    const auto entry = std::next(spoilt.begin(), static_cast<std::ptrdiff_t>(random() % spoilt.size()));
    const double value = hard[random() % hard.size()];
    const std::uint32_t way = random() % 4;
    std::visit(
        [&]<class Values>(Values& values) {
          using Number = typename Values::value_type;
          constexpr bool real = std::is_same_v<Number, double>;
          const auto number = [&]() -> Number {
            if constexpr (real) return value;
            return static_cast<Number>(std::abs(value) < 1e18 ? static_cast<std::int64_t>(value) : -7);
          }();
          if (way == 0) values.resize(values.size() + random() % 3);
          if (way == 1) values.resize(values.size() / 2);
          if (way == 2 && !values.empty()) values[random() % values.size()] = number;
          if (way == 3) std::ranges::fill(values, number);
        },
        entry->second);
    CAPTURE(k, entry->first, value, way);
    write_checkpoint(file, spoilt);
    try {
      Simulation second(scene, {.resume = file});
      for (int step = 0; step < 10; ++step) second.step();
      CHECK(second.steps() >= 0);
    } catch (const StateError&) {
      ++refused;
    } catch (const std::exception& error) {  // which the command reports
      CHECK(!std::string(error.what()).empty());
    }
  }
  CHECK(refused > 50);
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
    const std::string command = fmt::format("{} run --resume {} --quiet 2> {}/messages", STILLPOINT_BINARY, out, out);
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 3);
    CHECK(json_of(folder.path() / "summary.json")["status"] == "step-limit");
    CHECK(json_of(folder.path() / "summary.json")["steps"] == 400000);
  }
}
