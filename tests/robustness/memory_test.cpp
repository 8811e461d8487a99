// What a run takes of memory beside what is said beforehand.
#include <algorithm>
#include <optional>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/resource.h>

#include "child.hpp"
#include "files.hpp"
#include "plan/plan.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::Child;
using stillpoint::test::contents;
using stillpoint::test::run_of;
using stillpoint::test::TemporaryFolder;
namespace fs = std::filesystem;

TEST_CASE("cells, points, unknowns and bytes a point are known before a body is placed") {
  for (const auto& entry : fs::directory_iterator(STILLPOINT_PROBLEMS)) {
    if (entry.path().extension() != ".toml") continue;
    CAPTURE(entry.path());
    const Scene scene = load_scene(entry.path());
    const Plan plan = make_plan(scene);
    const auto phase = make_phase(scene);
    CHECK(plan.bytes_per_point == Approx(phase->shape().discretisation().bytes_per_point()).epsilon(0.02));
    CHECK(plan.size.points == Approx(static_cast<double>(phase->points())).epsilon(0.1));
    CHECK(plan.size.cells == Approx(static_cast<double>(phase->shape().discretisation().occupied_cells)).epsilon(0.1));
    const Discretisation of_phase = phase->shape().discretisation();
    CHECK(plan.size.unknowns ==
          Approx(static_cast<double>(phase->size() + of_phase.supported_degrees_of_freedom)).epsilon(0.15));
  }
}

TEST_CASE("formulas that are so many that they need memory are in the table, and constants and a few are not") {
  const auto bytes_of_formulas = [](const char* value, int count) {
    std::string forces = "force=[";
    for (int k = 0; k < count; ++k) forces += fmt::format("{{at=10.0, value='{}'}},", value);
    const Plan plan = make_plan(scenes::bar({forces + "]"}));
    const auto found = std::ranges::find(plan.memory, "formulas", &MemoryPart::what);
    return found == plan.memory.end() ? 0 : found->bytes;
  };
  CHECK(bytes_of_formulas("1e-9*sin(t)", 3000) == Approx(3e7).epsilon(0.3));
  CHECK(bytes_of_formulas("1e-9*sin(1)", 3000) == 0);
  CHECK(bytes_of_formulas("1e-9*sin(t)", 3) == 0);
}

// A sanitizer's memory is its own, and more address space than a limit leaves.
#ifndef STILLPOINT_SANITIZED
namespace {

double peak_of(const std::string& scene, const std::vector<std::string>& set) {
  const TemporaryFolder folder;
  Child child(run_of(scene, set, folder.path()), {}, (folder.path() / "messages").string());
  const auto status = child.wait();
  CHECK((status == 0 || status == 3));
  return child.peak_memory();
}

}  // namespace

TEST_CASE("the memory that a run is said to need is what it takes at its peak, to 30 %") {
  struct Case {
    const char* scene;
    std::vector<std::string> set;
  };
  const std::vector<Case> cases = {
      {"inclusion", {"grid.cells=[200, 200]"}},
      {"inclusion", {"grid.cells=[200, 200]", "damping.strategy=auto"}},
      {"inclusion", {"grid.cells=[150, 150]", "grid.basis=quadratic"}},
      {"inclusion", {"grid.cells=[120, 120]", "grid.basis=cubic"}},
      {"inclusion", {"grid.cells=[250, 250]", "grid.basis=quadratic", "damping.strategy=auto"}},
      {"inclusion", {"grid.cells=[200, 200]", "solve.method=newton"}},
      {"column", {"grid.cells=[16, 2500]"}},
      {"cantilever", {"grid.cells=[800, 20]"}},
      {"footing", {"grid.cells=[150, 150]"}},
      {"slope", {"grid.cells=[400, 160]", "output.stages=[]"}},
      {"bar", {"grid.cells=100000"}},
      {"oedometer", {"grid.cells=[50, 40, 50]", "mass.kind=lumped"}},
      {"oedometer", {"grid.cells=[40, 30, 30]"}},
      {"oedometer", {"grid.cells=[20, 20, 20]", "solve.method=newton"}},
      {"oedometer", {"grid.cells=[30, 20, 30]", "grid.basis=quadratic", "mass.kind=lumped"}},
      {"oedometer", {"grid.cells=[12, 12, 12]", "grid.basis=quadratic", "solve.method=newton"}},
  };
  const double program = peak_of("chain", {"stop.steps=3"});
  for (Case one : cases) {
    one.set.emplace_back("stop.steps=3");
    CAPTURE(one.scene, one.set);
    const double peak = peak_of(one.scene, one.set) - program;
    CHECK(make_plan(scenes::load(one.scene, one.set)).bytes() == Approx(peak).epsilon(0.3));
  }
}

TEST_CASE("a run that needs more memory than the process may take is refused with the key that asks for it") {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", messages = folder.path() / "messages";
  const auto refusal = [&](const std::vector<std::string>& set, const std::function<void()>& limits) {
    CHECK(Child(run_of("inclusion", set, out), {}, messages.string(), limits).wait() == 2);
    CHECK_FALSE(fs::exists(out));
    return contents(messages);
  };
  const auto limited = [](auto resource) {
    return [resource] {
      const rlimit limit{rlim_t{700} << 20, rlim_t{700} << 20};
      setrlimit(resource, &limit);
    };
  };
  const std::vector<std::string> large = {"grid.cells=[700, 700]", "grid.basis=quadratic"};
  CHECK_THAT(refusal(large, limited(RLIMIT_AS)),
             Catch::StartsWith("--set grid.cells=[700, 700]: the run needs about ") &&
                 Catch::Contains("factor of the stiffness") && Catch::Contains("ulimit -v leaves 0."));
  CHECK_THAT(refusal(large, limited(RLIMIT_DATA)), Catch::Contains("ulimit -d leaves 0."));
  std::string text = contents(STILLPOINT_PROBLEMS "/inclusion.toml");
  const std::string cells = "cells = [24, 24]", vast = "cells = [3000, 3000]";
  const std::size_t at = text.find(cells);
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  const fs::path file = folder.write("vast.toml", text.replace(at, cells.size(), vast));
  CHECK(Child({"run", file.string(), "--out", out.string()}, {}, messages.string(), limited(RLIMIT_AS)).wait() == 2);
  CHECK_THAT(contents(messages), Catch::Contains(fmt::format("vast.toml:{}:9: the run needs about ", line)));
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("a distance that is asked of a body whose factor has no room is told by auto's steps, or refused by name") {
  const TemporaryFolder folder;
  const fs::path messages = folder.path() / "messages", out = folder.path() / "out";
  const auto status = [&](const char* law) {
    const std::vector<std::string> set = {"grid.cells=[28, 28, 28]", "mass.kind=lumped", "stop.distance=1e-6",
                                          std::string("material.soil.law=") + law};
    const auto limits = [] {  // the factor alone takes 0.7 GB
      const rlimit limit{rlim_t{700} << 20, rlim_t{700} << 20};
      setrlimit(RLIMIT_AS, &limit);
    };
    return Child(run_of("oedometer", set, out), {}, messages.string(), limits).wait();
  };
  CHECK(status("neo-hookean") == 2);
  CHECK_THAT(contents(messages), Catch::Contains("--set stop.distance=1e-6: ") && Catch::Contains("has no room"));
  CHECK_FALSE(fs::exists(out));
  CHECK(status("linear-elastic") == 0);
  const auto summary = contents(out / "summary.json");
  CHECK_THAT(summary, Catch::Contains("\"omega_1\": null") && !Catch::Contains("\"distance\": null"));
}

TEST_CASE("a run whose memory ends at any large object says so in a line, with status 4, and keeps what it had") {
  struct Case {
    const char* scene;
    std::vector<std::string> set;
  };
  const std::vector<Case> cases = {
      {"block_on_wall", {"grid.cells=[30, 30]", "stop.steps=60", "output.stages=[1e-3, 1e-2]"}},
      {"hard/beam_in_phases", {"grid.cells=[33, 36]", "phase.max_motion=0.03", "stop.steps=20"}},
      {"inclusion", {"grid.cells=[30, 30]", "solve.method=newton", "damping={}", "integrator={}"}}};
  for (const auto& [scene, set] : cases) {
    std::optional<int> status;
    int refusals = 0;
    for (int from = 1; status != 0 && status != 3; from += from < 12 ? 1 : 19) {
      const TemporaryFolder folder;
      const fs::path out = folder.path() / "out", messages = folder.path() / "messages";
      CAPTURE(scene, from);
      status = Child(run_of(scene, set, out),
                     {"LD_PRELOAD=" + (fs::path(STILLPOINT_BINARY).parent_path() / "libno_memory.so").string(),
                      "NO_MEMORY_BYTES=4096", fmt::format("NO_MEMORY_FROM={}", from)},
                     messages.string())
                   .wait();
      REQUIRE((status == 0 || status == 3 || status == 4));
      if (status != 4) break;
      ++refusals;
      const std::string said = contents(messages);
      CHECK_THAT(said, Catch::Contains("no memory is left"));
      CHECK(std::ranges::count(said, '\n') == 1);
      CHECK_FALSE(fs::exists(out / "summary.json"));
    }
    CHECK(refusals > 12);
  }
}
#endif
