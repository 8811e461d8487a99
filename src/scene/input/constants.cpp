// The constants of a scene: numbers and formulas of each other, in any order.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/formula_parts.hpp"
#include "scene/input/scene_keys.hpp"
#include "scene/input/toml_source.hpp"

namespace stillpoint {
namespace {

/// A constant that is not yet computed.
struct Pending {
  const toml::node* node;
  std::set<std::string> needs{};  // those of the pending ones that its formula names
  std::vector<std::string> needed_by{};
};
using AllPending = std::map<std::string, Pending>;

/// Why a constant cannot have this name; empty if it can.
std::string fault_of_name(const std::string& name) {
  if (names_in(name) != std::vector<std::string>{name})
    return "it is not made of letters, digits and '_' only, or begins with a digit";
  if (name == "x" || name == "y" || name == "z" || name == "t") return "x, y, z and t are the variables of formulas";
  if (std::ranges::find(expression_constants(), name) != expression_constants().end())
    return fmt::format("every formula has a number of this name, {}", fmt::join(expression_constants(), " or "));
  if (std::ranges::find(expression_functions(), name) != expression_functions().end())
    return "a function has this name";
  return {};
}

void find_needs(AllPending& pending) {
  for (auto& [name, constant] : pending) {
    const auto* const text = constant.node->as_string();
    if (!text) continue;
    for (const std::string& other : names_in(text->get())) {
      const auto found = pending.find(other);
      if (found != pending.end() && constant.needs.insert(other).second) found->second.needed_by.push_back(name);
    }
  }
}

/// Every pending constant needs another pending one, so following the needs from any of them ends in a circle.
std::vector<std::string> find_circle(const AllPending& pending) {
  std::vector<std::string> chain = {pending.begin()->first};
  std::map<std::string, std::ptrdiff_t> seen = {{chain.front(), 0}};
  while (true) {
    const std::string& next = *pending.at(chain.back()).needs.begin();
    const auto [before, is_new] = seen.try_emplace(next, std::ssize(chain));
    chain.push_back(next);
    if (!is_new) return {chain.begin() + before->second, chain.end()};
  }
}

/// "a → b → a"
std::string told(const std::vector<std::string>& circle) {
  constexpr std::ptrdiff_t most = 20;
  if (std::ssize(circle) <= most) return fmt::format("{}", fmt::join(circle, " → "));
  return fmt::format("{} → … ({} in all)", fmt::join(circle.begin(), circle.begin() + most, " → "), circle.size() - 1);
}

}  // namespace

void resolve_constants(const toml::table& table, Reading& reading) {
  AllPending pending;
  for (auto&& [key, node] : table) {
    const std::string name(key.str());
    if (const std::string fault = fault_of_name(name); !fault.empty()) {
      reading.problem(location_of(key.source()), "constants",
                      fmt::format("{} cannot be a constant's name: {}", in_quotes(name), fault));
      reading.broken.insert(name);
    } else {
      pending[name].node = &node;
    }
  }
  find_needs(pending);
  std::vector<std::string> ready;
  const auto settle = [&](const std::string& name) {
    const auto settled = pending.extract(name);
    for (const std::string& other : settled.mapped().needed_by) {
      const auto found = pending.find(other);
      if (found == pending.end()) continue;  // already settled, in the same circle
      found->second.needs.erase(name);
      if (found->second.needs.empty()) ready.push_back(other);
    }
  };
  for (const auto& [name, constant] : pending)
    if (constant.needs.empty()) ready.push_back(name);
  while (!pending.empty()) {
    while (!ready.empty()) {
      const std::string name = std::move(ready.back());
      ready.pop_back();
      if (const auto value = read_number({*pending.at(name).node, "constants." + name, reading})) {
        reading.constants[name] = *value;
      } else {
        reading.broken.insert(name);
      }
      settle(name);
    }
    if (pending.empty()) return;
    std::vector<std::string> circle = find_circle(pending);
    reading.problem(location_of(pending.at(circle.front()).node->source()), "constants." + circle.front(),
                    fmt::format("is defined by itself: {}", told(circle)));
    circle.pop_back();
    reading.broken.insert(circle.begin(), circle.end());
    for (const std::string& name : circle) settle(name);
    // Settling one may have made another of them ready, which is settled by now.
    std::erase_if(ready, [&](const std::string& name) { return !pending.contains(name); });
  }
}

}  // namespace stillpoint
