#include "scene/input/scene_check.hpp"

#include <algorithm>

namespace stillpoint {
namespace {

bool fits_a_column(const std::string& name) {
  return std::ranges::none_of(
      name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == ',' || c == '"'; });
}

}  // namespace

void SceneCheck::one_of(const std::string& table, const Given& a, const Given& b, const std::string& both,
                        const std::string& neither) {
  const bool has_a = given(fmt::format("{}.{}", table, a.key), a.has_value);
  const bool has_b = given(fmt::format("{}.{}", table, b.key), b.has_value);
  if (has_a && has_b) add(fmt::format("{}.{}", table, b.key), both);
  if (!has_a && !has_b) add(table, neither);
}

void SceneCheck::add_unknown(const std::string& key, const std::string& what, const std::string& heading,
                             const std::string& name, const std::vector<std::string>& names) {
  add(key, names.empty() ? fmt::format("there is no {} {}; describe it in a table {}", what, in_quotes(name), heading)
                         : unknown_word("there is no " + what, name, names));
}

void SceneCheck::column_name(const std::string& name, const std::string& key) {
  wrong_if(!fits_a_column(name), key,
           "names a column of history.csv and cannot hold a comma, a quote or a control character");
}

void SceneCheck::contact_name(const std::string& name, const std::string& key) {
  wrong_if(!fits_a_column(name) || name.find('+') != std::string::npos, key,
           "cannot hold a comma, a quote, a + or a control character, since it stands in the names of columns of "
           "history.csv, where + joins two that touch");
}

bool SceneCheck::inside(const std::vector<double>& position, const NamedBox& box, const std::string& key) {
  if (!position.empty() &&
      position.size() != box.min.size()) {  // of a program: a file's were counted as they were read
    add(key, fmt::format("expected {} coordinates, found {}", box.min.size(), position.size()));
    return false;
  }
  for (std::size_t axis = 0; axis < position.size(); ++axis) {
    const double x = position[axis], min = box.min[axis], max = box.max[axis];
    if (x >= min && x <= max) continue;
    add(axis_key(key, axis), fmt::format("{} lies outside the {}, {} to {}", x, box.name, min, max));
    return false;
  }
  return true;
}

bool SceneCheck::check_interval(const std::string& table, const FaceInterval& part, std::size_t k,
                                const NamedBox& box) {
  const double min = box.min[part.along], max = box.max[part.along];
  bool inside = true;
  for (const auto& [key, end] : {std::pair(".from", part.from), {".to", part.to}}) {
    if (end >= min && end <= max) continue;
    add(end_key(table, key, k),
        fmt::format("{:g} lies outside the {}, whose face reaches from {:g} to {:g}", end, box.name, min, max));
    inside = false;
  }
  if (!inside || part.from < part.to) return inside;
  add(end_key(table, written(table + ".to") ? ".to" : ".from", k),
      fmt::format("the part from {:g} to {:g} is empty; expected from < to", part.from, part.to));
  return false;
}

std::string either(const std::vector<std::string>& words) {
  if (words.size() < 2) return fmt::format("{}", fmt::join(words, ""));
  return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

std::string why_no_state(const std::string& what, const std::vector<StressState>& states, StressState state) {
  if (std::ranges::find(states, state) != states.end()) return "";
  std::vector<std::string_view> names;
  for (const StressState one : states) names.push_back(to_string(one));
  return fmt::format("{} has no state '{}'; it has {}", what, to_string(state), fmt::join(names, ", "));
}

}  // namespace stillpoint
