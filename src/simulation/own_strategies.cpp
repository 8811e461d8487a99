// Dampings and relaxations of a program's own: their rows in the catalogue.
#include <stillpoint/own_damping.hpp>
#include <stillpoint/own_relaxation.hpp>

#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/registry.hpp"
#include "base/text.hpp"
#include "plan/catalogue.hpp"
#include "solvers/relaxation/relaxations.hpp"
#include "system/put_damping.hpp"

namespace stillpoint {
namespace {

enum class Kind { damping, relaxation };

StrategyInfo own_strategy(const std::string& name, const std::string& equation, const std::string& source, Kind kind) {
  static std::mutex mutex;
  static std::map<std::string, Kind> own;
  if (!is_plain_word(name))
    throw std::invalid_argument(
        fmt::format("a strategy cannot be called '{}'; expected {}", name, what_a_plain_word_is));
  const std::scoped_lock lock(mutex);
  const auto before = own.find(name);
  if (before == own.end() && (catalogue().strategy(name) || catalogue().static_method(name)))
    throw std::invalid_argument(fmt::format("'{}' is a method of this library; expected another name", name));
  if (before != own.end() && before->second != kind) {
    throw std::invalid_argument(fmt::format("'{}' was added as a {}; expected another name", name,
                                            kind == Kind::damping ? "relaxation" : "damping"));
  }
  own.emplace(name, kind);
  return {.name = kept_for_good(name), .equation = kept_for_good(equation), .source = kept_for_good(source)};
}

}  // namespace

void add_damping(const OwnDamping& about, OwnDampingForce force) {
  const double factor = about.stiffness_factor;
  if (!(factor >= 1) || !std::isfinite(factor))
    throw std::invalid_argument(fmt::format("the stiffness factor of a damping must be >= 1, found {}", factor));
  StrategyInfo info = own_strategy(about.name, about.equation, about.source, Kind::damping);
  info.keys = {"alpha"};
  info.is_local = true;
  put_damping(info, factor, std::move(force));
}

void add_relaxation(const OwnRelaxationInfo& about, MakeOwnRelaxation make) {
  StrategyInfo info = own_strategy(about.name, about.equation, about.source, Kind::relaxation);
  info.integrators = {"leapfrog"};
  info.is_relaxation = true;
  info.resets_velocity = true;  // for all that is known
  put_relaxation({.about = info, .needs_omega_1 = about.needs_omega_1}, std::move(make));
}

}  // namespace stillpoint
