#include "scene/own_loads.hpp"

#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"

namespace stillpoint {
namespace {

struct Table {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<const OwnLoadRow>, std::less<>> rows;
};
Table& table() {
  static Table all;
  return all;
}

}  // namespace

void add_load(const OwnLoad& about, OwnBodyForce b) {
  if (!is_plain_word(about.name))
    throw std::invalid_argument(
        fmt::format("a load cannot be called '{}'; expected {}", about.name, what_a_plain_word_is));
  if (!(about.settles_at >= 0))
    throw std::invalid_argument(fmt::format("a load cannot settle at t = {}; expected a time >= 0", about.settles_at));
  const std::scoped_lock lock(table().mutex);
  table().rows[about.name] = std::make_shared<OwnLoadRow>(OwnLoadRow{about, std::move(b)});
}

std::shared_ptr<const OwnLoadRow> own_load(const std::string& name) {
  const std::scoped_lock lock(table().mutex);
  const auto found = table().rows.find(name);
  return found == table().rows.end() ? nullptr : found->second;
}

std::string unknown_own_load(const std::string& name) {
  std::vector<std::string> names;
  {
    const std::scoped_lock lock(table().mutex);
    for (const auto& row : table().rows) names.push_back(row.first);
  }
  if (!names.empty()) return unknown_word("there is no load", name, names);
  return fmt::format(
      "there is no load {}; expected one that the program has added by add_load(), of which there are none",
      in_quotes(name));
}

bool own_load_varies(const Problem& problem) {
  const auto own = own_load(problem.own_load);
  return own && own->about.settles_at > 0;
}

}  // namespace stillpoint
