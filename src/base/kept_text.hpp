// Permanent storage of texts for rows that only refer to their words.
#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <string_view>

namespace stillpoint {

/// A copy of the text that stays to the end of the process.
inline std::string_view kept_for_good(const std::string& text) {
  static std::mutex mutex;
  static std::deque<std::string> all;
  const std::scoped_lock lock(mutex);
  return all.emplace_back(text);
}

}  // namespace stillpoint
