// The material laws on offer and their parameters: what scenes may say and `stillpoint list materials` shows.
#pragma once

#include <string_view>
#include <vector>

namespace stillpoint {

/// A number that a law takes; allowed where lower < value < upper.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double lower, upper;
  bool required;
  double fallback;  // where not required
};

struct LawInfo {
  std::string_view name, equation, source;
  std::vector<ParameterInfo> parameters;
};

const std::vector<LawInfo>& material_laws();

}  // namespace stillpoint
