// What the notes of a run say.
#pragma once

#include <stillpoint/summary.hpp>

#include <algorithm>
#include <string>

namespace stillpoint::test {

/// Whether one of the notes has this text in it.
inline bool says(const Summary& summary, const std::string& text) {
  return std::ranges::any_of(summary.notes,
                             [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

}  // namespace stillpoint::test
