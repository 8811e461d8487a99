// A run that is asked to end, at any moment, goes on where it was.
#include <string>

#include <catch2/catch.hpp>

#include "resumed_runs.hpp"

using namespace stillpoint;
using stillpoint::test::resumed;
using stillpoint::test::TemporaryFolder;
using stillpoint::test::unbroken;
namespace fs = std::filesystem;

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

TEST_CASE("wherever a run is interrupted, in the middle of a judgement too, it goes on with the same bits") {
  for (const char* name : {"ladder/pressed_plate", "cantilever"}) {
    CAPTURE(name);
    const Scene scene = scenes::load(name, {"stop.distance=1e-5", "checkpoint.every_steps=100000"});
    const std::string whole = unbroken(scene);
    const auto asks_until = [&](const fs::path& out, int last) {  // how often the run asks whether it is to end
      int asked = 0;
      run(scene,
          {.out = out, .interrupted = [&] { return fs::exists(out / "history.csv.partial") && ++asked == last; }});
      return asked;
    };
    const TemporaryFolder counted;
    const int asks = asks_until(counted.path(), -1);
    REQUIRE(asks > 40);
    for (int last = asks - 1; last > asks - 40; last -= 3) {
      CAPTURE(last, asks);
      const TemporaryFolder folder;
      asks_until(folder.path(), last);
      CHECK((resumed(folder.path()) == whole));
    }
  }
}
