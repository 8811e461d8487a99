#include "base/memory_room.hpp"

#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include <sys/resource.h>

namespace stillpoint {
namespace {

// The number behind a word at the beginning of a line of a file in /proc, converted from kB [bytes].
std::optional<double> kilobytes_in(const char* file, const std::string& word) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(word)) return 1024 * std::stod(line.substr(word.size()));
  }
  return std::nullopt;
}

// The number in a file; empty if the file is absent, or says "max".
std::optional<double> number_in(const std::string& file) {
  double number = 0;
  if (std::ifstream(file) >> number) return number;
  return std::nullopt;
}

// The folder of the process in the hierarchy of control groups, version 2.
std::string control_group() {
  std::ifstream lines("/proc/self/cgroup");
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("0::")) return "/sys/fs/cgroup" + line.substr(3);
  }
  return "/sys/fs/cgroup";
}

}  // namespace

MemoryRoom memory_room() {
  MemoryRoom room{.bytes = std::numeric_limits<double>::infinity(), .set_by = "nothing"};
  const auto bound = [&](std::optional<double> most, std::optional<double> taken, const std::string& by) {
    if (most && *most - taken.value_or(0) < room.bytes) room = {*most - taken.value_or(0), by};
  };
  bound(kilobytes_in("/proc/meminfo", "MemAvailable:"), 0, "MemAvailable of /proc/meminfo");
  for (const std::string& group : {control_group(), std::string("/sys/fs/cgroup")})
    bound(number_in(group + "/memory.max"), number_in(group + "/memory.current"), "memory.max of the control group");
  const std::string version_1 = "/sys/fs/cgroup/memory/memory.";
  bound(number_in(version_1 + "limit_in_bytes"), number_in(version_1 + "usage_in_bytes"),
        "memory.limit_in_bytes of the control group");
  const auto bound_process = [&](int resource, const char* taken, const char* by) {
    rlimit limit{};
    if (getrlimit(static_cast<__rlimit_resource>(resource), &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      bound(static_cast<double>(limit.rlim_cur), kilobytes_in("/proc/self/status", taken), by);
  };
  bound_process(RLIMIT_AS, "VmSize:", "the limit on the process's address space, ulimit -v");
  bound_process(RLIMIT_DATA, "VmData:", "the limit on the process's data, ulimit -d");
  return room;
}

}  // namespace stillpoint
