// Rows of a catalogue to which a program adds some of its own.
#pragma once

#include <algorithm>
#include <list>
#include <mutex>
#include <utility>
#include <vector>

namespace stillpoint {

/// What rows() has given stays as it is for good, whatever is added later: nobody's pointer to a row dangles.
template <class Row>
class GrowingTable {
 public:
  explicit GrowingTable(std::vector<Row> rows) { versions_.push_back(std::move(rows)); }

  /// As the table is now.
  const std::vector<Row>& rows() const {
    const std::scoped_lock lock(mutex_);
    return versions_.back();
  }
  /// Adds a row behind the others, or in the place of the one of which same(row) is true.
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

}  // namespace stillpoint
