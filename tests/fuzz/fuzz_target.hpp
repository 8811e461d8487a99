// What the targets of libFuzzer share. A target reads whatever bytes it is given; a fault ends the process.
#pragma once

#include <stillpoint/scene_error.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

/// Called by libFuzzer, or by replay.cpp, for each input. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace stillpoint::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) { return {data, data + size}; }

/// Ends the process, as a crash would, unless it is true.
inline void require(bool is_true, const char* claim) {
  if (is_true) return;
  std::fprintf(stderr, "not true: %s\n", claim);
  std::abort();
}

/// Bad input is told with a place and in one line.
inline void require_clear(const std::vector<Mistake>& problems) {
  const auto printable = [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; };
  for (const auto& [where, message, key] : problems) {
    if (!std::ranges::all_of(message, printable)) std::fprintf(stderr, "%s\n", message.c_str());
    require(!message.empty(), "a problem has a message");
    require(std::ranges::all_of(message, printable), "a message is one line of printable characters");
    require(!where.file.empty() && (where.line > 0) == (where.column > 0), "a problem has a place");
  }
}

}  // namespace stillpoint::fuzz
