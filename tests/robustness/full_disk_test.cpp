// Runs on a disk that is full from some call on, whichever it is.
#include <algorithm>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "child.hpp"
#include "files.hpp"
#include "output/checkpoint_file.hpp"
#include "output/hdf5_file.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::Child;
using stillpoint::test::contents;
using stillpoint::test::json_of;
using stillpoint::test::run_of;
using stillpoint::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

// History, probes, three frames of fields, three checkpoints, a summary and a report.
const std::vector<std::string> settings = {"grid.cells=[8, 8]", "stop.steps=60", "checkpoint.every_steps=40",
                                           "output.stages=[1e-3, 1e-2]"};
constexpr int not_in_equilibrium = 3, failed = 4;

std::vector<std::string> run_into(const fs::path& out) { return run_of("block_on_wall", settings, out); }

std::vector<std::string> full(const fs::path& out, int from, bool once) {
  std::vector<std::string> variables = {
      "LD_PRELOAD=" + (fs::path(STILLPOINT_BINARY).parent_path() / "libfull_disk.so").string(),
      "ASAN_OPTIONS=verify_asan_link_order=0", "FULL_DISK_FOLDER=" + out.string(),
      fmt::format("FULL_DISK_FROM={}", from)};
  if (once) variables.emplace_back("FULL_DISK_ONCE=1");
  return variables;
}

std::string history_in(const fs::path& out) {
  for (const char* name : {"history.csv", "history.csv.partial"})
    if (fs::exists(out / name)) return contents(out / name);
  return "";
}

// What a run has left that can be read.
struct Left {
  std::size_t rows = 0, frames = 0, checkpoint_steps = 0;
  auto operator<=>(const Left&) const = default;
};

std::size_t steps_of(const fs::path& checkpoint) {
  return static_cast<std::size_t>(
      std::get<std::vector<std::int64_t>>(read_checkpoint(checkpoint).at("motion/integrator/steps")).front());
}

Left left_in(const fs::path& out) {
  const std::string history = history_in(out);
  Left left{.rows = static_cast<std::size_t>(std::ranges::count(history, '\n'))};
  CHECK((history.empty() || history.back() == '\n'));
  if (fs::exists(out / "checkpoint.h5")) left.checkpoint_steps = steps_of(out / "checkpoint.h5");
  if (fs::exists(out / "checkpoint-previous.h5")) {
    CHECK(steps_of(out / "checkpoint-previous.h5") <= left.checkpoint_steps);
    CHECK(left.checkpoint_steps > 0);
  }
  if (fs::exists(out / "fields.h5")) {
    const Hdf5File whole(Hdf5File::Existing{out / "fields.h5"});
    left.frames = whole.names_in("/").size() - 1;  // beside /vertex
    return left;
  }
  if (!fs::exists(out / "fields.partial")) return left;
  for (const auto& entry : fs::directory_iterator(out / "fields.partial")) {
    if (entry.path().extension() != ".h5") continue;
    CHECK(Hdf5File(Hdf5File::Existing{entry.path()}).names_in("/").size() == 2);
    ++left.frames;
  }
  return left;
}

// Files under their final names are whole: those of the run that nothing has stopped.
void check_final_names(const fs::path& out, const fs::path& unbroken) {
  for (const char* name : {"history.csv", "fields.h5", "fields.xdmf"}) {
    CAPTURE(name);
    if (fs::exists(out / name)) CHECK((contents(out / name) == contents(unbroken / name)));
  }
  if (fs::exists(out / "summary.json")) CHECK(json_of(out / "summary.json")["steps"] == 60);
  if (fs::exists(out / "report.html")) CHECK(contents(out / "report.html").ends_with("</html>\n"));
  CHECK(contents(unbroken / "history.csv").starts_with(history_in(out)));
}

}  // namespace

TEST_CASE("on a disk that is full from any call on a run fails by name, loses nothing and can be gone on with") {
  const TemporaryFolder folder;
  const fs::path unbroken = folder.path() / "unbroken";
  REQUIRE(Child(run_into(unbroken)).wait() == not_in_equilibrium);
  for (const bool once : {false, true}) {
    Left before;
    int call = 1;
    for (;; call += call < 40 ? 1 : 7) {  // every kind of call is among them
      CAPTURE(call, once);
      const fs::path out = folder.path() / fmt::format("{}-{}", call, once), messages = folder.path() / "messages";
      const auto status = Child(run_into(out), full(out, call, once), messages.string()).wait();
      if (status == not_in_equilibrium) break;
      const std::string said = contents(messages);
      CAPTURE(said);
      REQUIRE(status == failed);
      CHECK_THAT(said, Catch::Contains("No space left on device") && Catch::Contains(out.string()));
      CHECK(std::ranges::count(said, '\n') == 1);
      if (!fs::exists(out)) continue;
      const Left left = left_in(out);
      CHECK(left.rows >= before.rows);
      CHECK(left.frames >= before.frames);
      CHECK(left.checkpoint_steps >= before.checkpoint_steps);
      before = left;
      check_final_names(out, unbroken);
      if (fs::exists(out / "checkpoint.h5")) {
        CHECK(Child({"run", "--resume", out.string(), "--quiet", "--threads", "1"}, {}, messages.string()).wait() ==
              not_in_equilibrium);
        check_final_names(out, unbroken);
        CHECK(left_in(out) == left_in(unbroken));
        for (const char* last : {"summary.json", "report.html"}) CHECK(fs::exists(out / last));
      }
      fs::remove_all(out);
    }
    CHECK(call > 100);  // calls of a run
  }
}
