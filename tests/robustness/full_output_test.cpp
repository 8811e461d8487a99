// What cannot be printed is told, and is no success.
#include <cstdlib>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/wait.h>

#include "files.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace {

struct Ending {
  int status = -1;
  std::string said;
};

Ending into(const std::string& device, const std::string& arguments, const test::TemporaryFolder& folder) {
  const std::string messages = (folder.path() / "messages").string();
  const int status =
      std::system(fmt::format("'{}' {} > {} 2> '{}'", STILLPOINT_BINARY, arguments, device, messages).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, test::contents(messages)};
}

}  // namespace

TEST_CASE("every command whose output finds no room ends with status 4 and says so") {
  const test::TemporaryFolder folder;
  const std::string bar = STILLPOINT_PROBLEMS "/bar.toml", out = (folder.path() / "out").string();
  for (const std::string& command :
       {fmt::format("run {} --out {}", bar, out), std::string("list"), std::string("list keys --format schema"),
        std::string("--version"), std::string("--help"), fmt::format("check {}", bar), fmt::format("spectrum {}", bar),
        fmt::format("compare {} --strategies viscous --repeats 0 --out {}-compare", bar, out),
        fmt::format("converge {} --levels 2 --no-sources --out {}-converge", bar, out)}) {
    CAPTURE(command);
    const Ending full = into("/dev/full", command, folder);
    CHECK(full.status == 4);
    CAPTURE(full.said);
    CHECK(full.said.find("cannot write to") != std::string::npos);
    CHECK(into("/dev/null", command, folder).status == 0);
  }
  CHECK(into("/dev/full", fmt::format("run {} --quiet --out {}", bar, out), folder).status == 0);
}
