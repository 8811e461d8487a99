// Two runs into one folder at once would each leave half of what it holds.
#include <stillpoint/scene_error.hpp>

#include <filesystem>
#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/atomic_file.hpp"
#include "child.hpp"
#include "files.hpp"
#include "output/run_folder.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

// Runs until it is ended.
const std::vector<std::string> endless = {"stop.residual=0", "stop.kinetic_energy=0", "stop.time=1e9",
                                          "checkpoint.every_steps=200"};
const std::string lock = "run.lock";

struct Answer {
  std::optional<int> status;
  std::string said;
};
Answer answer(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  const std::string messages = (folder / "messages").string();
  Answer found;
  found.status = Child(arguments, {}, messages).wait();
  found.said = contents(messages);
  return found;
}

}  // namespace

TEST_CASE("a second run into a folder, new or resumed, is refused with the number of the first, which goes on") {
  const test::TemporaryFolder folder;
  const auto out = folder.path() / "out";
  Child first(run_of("column", endless, out));
  REQUIRE(first.wait_until([&] { return std::filesystem::exists(out / "checkpoint.h5"); }));
  const std::string number = contents(out / lock);
  for (const auto& again : {run_of("column", {}, out), std::vector<std::string>{"run", "--resume", out.string()}}) {
    const Answer second = answer(again, folder.path());
    CHECK(second.status == 2);
    CAPTURE(second.said);
    CHECK(second.said.find(fmt::format("process {} is running into this folder", std::stol(number))) !=
          std::string::npos);
  }
  CHECK(std::filesystem::exists(out / "history.csv.partial"));
  first.send(SIGINT);
  CHECK(first.wait() == 3);
  CHECK_FALSE(std::filesystem::exists(out / lock));
  CHECK(std::filesystem::exists(out / "summary.json"));
}

TEST_CASE("a lock that a process has left that was killed is no obstacle, to a new run or to one that resumes") {
  const test::TemporaryFolder folder;
  const auto out = folder.path() / "out";
  {
    Child first(run_of("column", endless, out));
    REQUIRE(first.wait_until([&] { return std::filesystem::exists(out / "checkpoint.h5"); }));
    first.send(SIGKILL);
    CHECK_FALSE(first.wait());
  }
  CHECK(std::filesystem::exists(out / lock));
  Child resumed({"run", "--resume", out.string(), "--quiet"});
  REQUIRE(resumed.wait_until([&] { return resumed.heeds(SIGINT); }));
  resumed.send(SIGINT);
  CHECK(resumed.wait() == 3);
  CHECK(answer(run_of("column", {"stop.steps=3"}, out), folder.path()).status == 3);
  CHECK_FALSE(std::filesystem::exists(out / lock));
}

TEST_CASE("a thread shares the lock that it has, and any other is refused") {
  const test::TemporaryFolder folder;
  auto first = lock_folder(folder.path());
  auto second = lock_folder(folder.path() / "." / "");
  bool refused = false;
  const auto try_elsewhere = [&] {
    refused = false;
    std::thread([&] {
      try {
        lock_folder(folder.path());
      } catch (const SceneError&) {
        refused = true;
      }
    }).join();
  };
  first.reset();
  try_elsewhere();
  CHECK(refused);
  second.reset();
  try_elsewhere();
  CHECK_FALSE(refused);
}

TEST_CASE("settings do not go with a run that is resumed") {
  const test::TemporaryFolder folder;
  const auto out = folder.path() / "out";
  const Answer first = answer(run_of("column", {"stop.steps=50", "checkpoint.every_steps=20"}, out), folder.path());
  REQUIRE(first.status == 3);
  const std::string before = contents(out / "checkpoint.h5");
  const Answer resumed = answer({"run", "--resume", out.string(), "--set", "damping.c=5", "--quiet"}, folder.path());
  CHECK(resumed.status == 2);
  CAPTURE(resumed.said);
  CHECK(resumed.said.find("--set") != std::string::npos);
  CHECK(contents(out / "checkpoint.h5") == before);
}
