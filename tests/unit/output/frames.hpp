// Frames of fields for the tests of their writers, and a disk that is full.
#pragma once

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "output/field_frame.hpp"

namespace stillpoint::test {

// Numbers that no compression makes small.
inline FieldFrame a_frame(double t, std::size_t points = 3) {
  FieldFrame frame{t, 2, points, {}, {{"u", 2, {}}, {"stress", 4, {}}, {"plastic_strain", 1, {}}}, {}};
  unsigned long state = 1;
  const auto fill = [&](std::vector<double>& values, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      values.push_back(static_cast<double>(state));
    }
  };
  fill(frame.position, 2 * points);
  for (PointField& field : frame.fields) fill(field.values, static_cast<std::size_t>(field.components) * points);
  frame.material.assign(points, 1);
  return frame;
}

inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// No file of this process grows beyond some size, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace stillpoint::test
