// What scenes choose by name: the rows of this library, and those that a program adds.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stillpoint {

/// A table of rows: the properties of each, with its name, and what makes it.
template <class Info, class Make>
class Registry {
 public:
  struct Row {
    Info info;
    Make make;
  };
  explicit Registry(const std::vector<Row>& built_in) {
    std::vector<Info>& infos = editions_.emplace_back();
    for (const Row& row : built_in) {
      infos.push_back(row.info);
      makers_.emplace(name_of(row.info), row.make);
    }
  }

  /// The properties of all rows as they are now. A vector that was returned is never changed or freed, whatever is
  /// added later: no pointer to a row dangles.
  const std::vector<Info>& infos() const {
    const std::scoped_lock lock(mutex_);
    return editions_.back();
  }
  /// What makes the row of this name; Make() if there is none.
  Make maker(std::string_view name) const {
    const std::scoped_lock lock(mutex_);
    const auto found = makers_.find(name);
    return found == makers_.end() ? Make() : found->second;
  }
  /// Adds a row behind the others, or replaces the one of the same name.
  void put(const Info& info, Make make) {
    const std::scoped_lock lock(mutex_);
    makers_.insert_or_assign(std::string(name_of(info)), std::move(make));
    std::vector<Info> next = editions_.back();
    const auto found = std::ranges::find(next, name_of(info), name_of);
    if (found == next.end()) {
      next.push_back(info);
    } else {
      *found = info;
    }
    editions_.push_back(std::move(next));
  }

 private:
  static std::string_view name_of(const Info& info) {
    if constexpr (requires { info.about; }) {
      return info.about.name;
    } else {
      return info.name;
    }
  }

  mutable std::mutex mutex_;
  std::list<std::vector<Info>> editions_;
  std::map<std::string, Make, std::less<>> makers_;
};

/// A copy of the text that stays to the end of the process.
inline std::string_view kept_for_good(const std::string& text) {
  static std::mutex mutex;
  static std::deque<std::string> all;
  const std::scoped_lock lock(mutex);
  return all.emplace_back(text);
}

}  // namespace stillpoint
