#include <stillpoint/catalogue.hpp>

#include <algorithm>

namespace stillpoint {
namespace {

template <class Row, class Name>
const Row* find_row(const std::vector<Row>& rows, std::string_view name, Name Row::*of_row) {
  const auto found = std::ranges::find(rows, name, of_row);
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace

bool StrategyInfo::goes_with(std::string_view integrator) const {
  return integrators.empty() ||
         std::ranges::any_of(integrators, [&](std::string_view begin) { return integrator.starts_with(begin); });
}

bool StrategyInfo::uses(std::string_view key) const { return std::ranges::find(keys, key) != keys.end(); }

bool StrategyInfo::takes(std::string_view key) const {
  const bool of_some_damping = key == "c" || key == "alpha";
  return uses(key) || (of_some_damping && !is_relaxation);
}

const LawInfo* Catalogue::law(std::string_view name) const { return find_row(laws, name, &LawInfo::name); }
const StrategyInfo* Catalogue::strategy(std::string_view name) const {
  return find_row(strategies, name, &StrategyInfo::name);
}
const StaticMethodInfo* Catalogue::static_method(std::string_view name) const {
  return find_row(static_methods, name, &StaticMethodInfo::name);
}
const MethodInfo* Catalogue::method(std::string_view name) const { return find_row(methods, name, &MethodInfo::name); }
const SolutionInfo* Catalogue::solution(std::string_view name) const {
  return find_row(solutions, name, &SolutionInfo::name);
}

}  // namespace stillpoint
