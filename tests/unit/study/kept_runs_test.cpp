// Finished runs of a study that the next one takes from the disk.
#include "study/kept_runs.hpp"

#include <stillpoint/state_archive.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::Contains;

namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();
const std::vector<std::string> eight_cells = {"grid.cells=[8]"};

LevelRun finished_run() {
  LevelRun run;
  run.is_there = true;
  run.level.set = eight_cells;
  run.level.step = 0.1, run.level.wall_s = 1e-3;
  run.level.points = 12, run.level.dofs = 7, run.level.evaluations = 1L << 40;
  run.level.status = RunStatus::equilibrium;
  run.level.reason = "a reason with \"quotes\"";
  run.floor = 1e-13;
  run.norms = {{"u_l2", 1.0 / 3}, {"u_max", not_there}};
  run.no_energy = "why not";
  run.probes = {{"tip.u", std::nextafter(1.0, 2.0)}};
  run.probe_errors = {not_there};
  run.u = {0.1, not_there, -5e-324, 1.7e308};
  run.stress = {-0.0};
  run.volume = {0.7};
  run.notes = {"a note"};
  return run;
}

void check_same(double found, double kept) {
  if (std::isnan(kept)) {
    CHECK(std::isnan(found));
  } else {
    CHECK(found == kept);
  }
}
void check_same(const std::vector<double>& found, const std::vector<double>& kept) {
  REQUIRE(found.size() == kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) check_same(found[i], kept[i]);
}
void check_same(const std::pair<std::string, double>& found, const std::pair<std::string, double>& kept) {
  CHECK(found.first == kept.first);
  check_same(found.second, kept.second);
}

}  // namespace

TEST_CASE("a run that is kept is found again to the last bit, also what is not a number") {
  const TemporaryFolder folder;
  const KeptRuns kept(folder.path(), true, scenes::bar());
  const LevelRun run = finished_run();
  kept.keep("level", run);
  const std::optional<LevelRun> found = kept.find("level", eight_cells);
  REQUIRE(found);
  CHECK(found->is_there);
  CHECK(found->level.set == eight_cells);
  CHECK(found->level.status == RunStatus::equilibrium);
  CHECK(found->level.exit_status == 0);
  CHECK(found->level.reason == run.level.reason);
  CHECK(found->level.step == 0.1);
  CHECK(found->level.points == 12);
  CHECK(found->level.dofs == 7);
  CHECK(found->level.evaluations == 1L << 40);
  CHECK(found->level.wall_s == 1e-3);
  CHECK(found->floor == 1e-13);
  CHECK(found->no_energy == "why not");
  CHECK(found->notes == run.notes);
  REQUIRE(found->norms.size() == 2);
  check_same(found->norms[0], run.norms[0]);
  check_same(found->norms[1], run.norms[1]);
  REQUIRE(found->probes.size() == 1);
  check_same(found->probes[0], run.probes[0]);
  check_same(found->probe_errors, run.probe_errors);
  check_same(found->u, run.u);
  check_same(found->stress, run.stress);
  check_same(found->volume, run.volume);
}

TEST_CASE("nothing is kept of a run that did not come to its end, or without a folder") {
  const TemporaryFolder folder;
  const KeptRuns kept(folder.path(), true, scenes::bar());
  LevelRun run = finished_run();
  run.is_there = false;
  kept.keep("level", run);
  CHECK_FALSE(kept.find("level", eight_cells));
  CHECK(std::filesystem::is_empty(folder.path()));
  CHECK_NOTHROW(KeptRuns({}, true, scenes::bar()).keep("level", finished_run()));
  CHECK_FALSE(KeptRuns({}, true, scenes::bar()).find("level", eight_cells));
}

TEST_CASE("a study that begins afresh takes no kept run, and removes that of each level which it begins") {
  const TemporaryFolder folder;
  const KeptRuns resumed(folder.path(), true, scenes::bar()), afresh(folder.path(), false, scenes::bar());
  resumed.keep("level", finished_run());
  CHECK_FALSE(afresh.find("level", eight_cells));
  resumed.begin("level");
  CHECK(resumed.find("level", eight_cells));
  afresh.begin("level");
  CHECK_FALSE(resumed.find("level", eight_cells));
}

TEST_CASE("a kept run of another scene, version or refinement is refused with what differs, and a damaged one too") {
  const TemporaryFolder folder;
  const Scene scene = scenes::bar();
  const KeptRuns kept(folder.path(), true, scene);
  kept.keep("level", finished_run());
  CHECK_THROWS_WITH(kept.find("level", {"grid.cells=[16]"}), Contains("is a run that was refined in another way"));
  Scene other = scene;
  other.text += "\n";
  CHECK_THROWS_WITH(KeptRuns(folder.path(), true, other).find("level", eight_cells), Contains("another scene text"));
  CHECK_THROWS_WITH(KeptRuns(folder.path(), true, scenes::bar({"stop.time=1"})).find("level", eight_cells),
                    Contains("another list of --set") && Contains("leave out --resume to begin afresh"));
  std::string text = contents(folder.path() / "level.json");
  folder.write("other.json", text.replace(text.find("\"version\":\""), 11, "\"version\":\"0"));
  CHECK_THROWS_WITH(kept.find("other", eight_cells), Contains("another version"));
  for (const std::string damaged : {"", "{}", "[1", "{\"of\": 3}"}) {
    CAPTURE(damaged);
    folder.write("damaged.json", damaged);
    CHECK_THROWS_AS(kept.find("damaged", eight_cells), StateError);
    CHECK_THROWS_WITH(kept.find("damaged", eight_cells), Contains("is damaged, or no run of a study"));
  }
}
