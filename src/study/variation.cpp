#include <stillpoint/converge.hpp>

#include <algorithm>
#include <utility>

#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

// Splits at the commas that are in no array, table or string.
std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char letter : text) {
    if (quote != 0) {
      if (letter == quote) quote = 0;
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth;
    } else if (letter == ']' || letter == '}') {
      --depth;
    }
    if (letter == ',' && depth == 0 && quote == 0) {
      parts.emplace_back();
    } else if (letter != ' ' || !parts.back().empty()) {
      parts.back() += letter;
    }
  }
  return parts;
}

}  // namespace

Variation variation_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  Variation variation;
  if (equals != std::string::npos) variation = {text.substr(0, equals), split(text.substr(equals + 1))};
  if (variation.key.empty() || variation.values.size() < 2 || std::ranges::count(variation.values, "") > 0)
    throw_option_error("--vary", text, "expected a key and two values or more, KEY=VALUE,VALUE,...");
  for (auto value = variation.values.begin(); value != variation.values.end(); ++value)
    if (std::find(variation.values.begin(), value, *value) != value)
      throw_option_error("--vary", text, "the value " + *value + " stands there twice");
  return variation;
}

std::vector<std::vector<std::string>> settings_of_series(const std::vector<std::string>& vary) {
  std::vector<Variation> varied;
  for (const std::string& text : vary) {
    varied.push_back(variation_of(text));
    if (varied.size() > 2) throw_option_error("--vary", text, "is the third; expected two keys at most");
    if (varied.size() == 2 && varied.front().key == varied.back().key)
      throw_option_error("--vary", text, "is a key that is varied already; expected all its values at once");
  }
  std::vector<std::vector<std::string>> all(1);
  for (const Variation& variation : varied) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& set : all) {
      for (const std::string& value : variation.values) {
        longer.push_back(set);
        longer.back().push_back(variation.key + "=" + value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

}  // namespace stillpoint
