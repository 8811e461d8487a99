#include "base/kept_text.hpp"

#include <deque>
#include <mutex>

namespace stillpoint {

std::string_view kept_for_good(const std::string& text) {
  static std::mutex mutex;
  static std::deque<std::string> all;
  const std::scoped_lock lock(mutex);
  return all.emplace_back(text);
}

}  // namespace stillpoint
