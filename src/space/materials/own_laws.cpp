// User-defined material laws.
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/growing_table.hpp"
#include "base/text.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {
namespace {

using OfStates = std::map<StressState, MakeLaw>;

struct OwnLaws {
  std::mutex mutex;
  std::map<std::string, OfStates, std::less<>> laws;
};
OwnLaws& own_laws() {
  static OwnLaws all;
  return all;
}

void check_parameters(const OwnLaw& about) {
  std::set<std::string> taken = {"law", "rho"};
  for (const OwnParameter& parameter : about.parameters) {
    if (parameter.name.empty() || !taken.insert(parameter.name).second)
      throw std::invalid_argument(
          fmt::format("the law '{}' has two parameters '{}', or one without a name", about.name, parameter.name));
    if (!(parameter.lower < parameter.upper))
      throw std::invalid_argument(fmt::format("the parameter '{}' of the law '{}' has no value between {} and {}",
                                              parameter.name, about.name, parameter.lower, parameter.upper));
  }
}

LawInfo row_of(const OwnLaw& about, const OfStates& of_states) {
  LawInfo info{kept_for_good(about.name), kept_for_good(about.equation), kept_for_good(about.source), {}, {}};
  for (const auto& [state, make] : of_states) info.states.push_back(state);
  for (const OwnParameter& p : about.parameters)
    info.parameters.push_back({kept_for_good(p.name), kept_for_good(p.unit), kept_for_good(p.meaning), p.lower, p.upper,
                               false, !p.fallback, p.fallback.value_or(0)});
  info.parameters.push_back({"rho", "kg/m3", "density", 0, std::numeric_limits<double>::infinity(), false, true, 0});
  return info;
}

}  // namespace

void add_law(const OwnLaw& about, const OfStates& of_states) {
  if (!is_plain_word(about.name))
    throw std::invalid_argument(
        fmt::format("a law cannot be called '{}'; expected {}", about.name, what_a_plain_word_is));
  if (of_states.empty()) throw std::invalid_argument(fmt::format("the law '{}' has no stress state", about.name));
  check_parameters(about);
  const std::scoped_lock lock(own_laws().mutex);
  const bool is_known = std::ranges::find(material_laws(), about.name, &LawInfo::name) != material_laws().end();
  if (is_known && !own_laws().laws.contains(about.name))
    throw std::invalid_argument(fmt::format("'{}' is a law of this library; expected another name", about.name));
  own_laws().laws[about.name] = of_states;
  put_law(row_of(about, of_states));
}

std::shared_ptr<const LawAnswers> own_law_answers(const std::string& law, StressState state,
                                                  const LawParameters& parameters) {
  MakeLaw make;
  {
    const std::scoped_lock lock(own_laws().mutex);
    const auto found = own_laws().laws.find(law);
    if (found == own_laws().laws.end()) return nullptr;
    make = found->second.at(state);
  }
  return make(parameters);
}

}  // namespace stillpoint
