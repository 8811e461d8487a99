// What the tests of runs share: the files that a run has not finished.
#pragma once

#include <filesystem>

namespace stillpoint::test {

inline bool is_stepping(const std::filesystem::path& out) {
  return std::filesystem::exists(out / "history.csv.partial");
}

inline bool leftovers(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".partial") return true;
  }
  return false;
}

}  // namespace stillpoint::test
