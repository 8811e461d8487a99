// A table of catalogue rows to which a program may add rows of its own, whose texts are kept to the end.
#pragma once

#include <algorithm>
#include <deque>
#include <list>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stillpoint {

/// A vector that rows() has returned is never changed or freed, whatever is added later: no pointer to a row dangles.
template <class Row>
class GrowingTable {
 public:
  explicit GrowingTable(std::vector<Row> rows) { versions_.push_back(std::move(rows)); }

  /// The table as it is now.
  const std::vector<Row>& rows() const {
    const std::scoped_lock lock(mutex_);
    return versions_.back();
  }
  /// Adds a row behind the others, or replaces the one for which same(row) is true.
  template <class Same>
  void put(Row row, const Same& same) {
    const std::scoped_lock lock(mutex_);
    std::vector<Row> next = versions_.back();
    const auto found = std::ranges::find_if(next, same);
    if (found == next.end()) {
      next.push_back(std::move(row));
    } else {
      *found = std::move(row);
    }
    versions_.push_back(std::move(next));
  }

 private:
  mutable std::mutex mutex_;
  std::list<std::vector<Row>> versions_;
};

/// A copy of the text that stays to the end of the process.
inline std::string_view kept_for_good(const std::string& text) {
  static std::mutex mutex;
  static std::deque<std::string> all;
  const std::scoped_lock lock(mutex);
  return all.emplace_back(text);
}

}  // namespace stillpoint
