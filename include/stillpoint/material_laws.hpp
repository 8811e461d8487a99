// The material laws on offer, their stress states and their parameters: what scenes may say and `stillpoint list
// materials` shows.
#pragma once

#include <stillpoint/scene.hpp>

#include <string_view>
#include <vector>

namespace stillpoint {

/// A number that a law takes; allowed where lower < value < upper, and at lower itself where lower_allowed.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double lower, upper;
  bool lower_allowed;
  bool required;
  double fallback;                // where not required
  std::string_view same_as = {};  // an earlier parameter, whose value is the fallback then; empty: none
};

/// A word that a law takes.
struct ChoiceInfo {
  std::string_view name, meaning;
  std::vector<std::string_view> values;
  std::string_view fallback;
};

struct LawInfo {
  std::string_view name, equation, source;
  std::vector<StressState> states;
  std::vector<ParameterInfo> parameters;
  std::vector<ChoiceInfo> choices;
};

const std::vector<LawInfo>& material_laws();

}  // namespace stillpoint
