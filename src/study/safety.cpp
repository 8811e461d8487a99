#include <stillpoint/safety.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"
#include "plan/catalogue.hpp"
#include "scene/stages.hpp"
#include "scene/throw_scene_error.hpp"
#include "study/reduced_body.hpp"
#include "study/strength_reduction.hpp"

namespace stillpoint {
namespace {

/// The bodies of the last stage, which is the one whose equilibrium counts.
std::vector<BodySpec> last_bodies(Scene scene) {
  while (!scene.stages.empty()) begin_next_stage(scene);
  return scene.bodies;
}

void check(const Scene& scene) {
  const std::vector<BodySpec> bodies = last_bodies(scene);
  const auto reducible = [&](const BodySpec& body) {
    return has_reducible_strength(scene.materials.at(body.material));
  };
  for (const BodySpec& body : bodies) {
    const std::string& law = scene.materials.at(body.material).law;
    const LawInfo* const info = catalogue().law(law);
    if (info && info->history_dependent && !info->has_strength)
      throw_scene_error(fmt::format("material.{}.law", body.material),
                        fmt::format("the strength of '{}' has no name that a factor could divide; expected the law "
                                    "\"mohr-coulomb\" or \"drucker-prager\"",
                                    law));
  }
  if (std::ranges::none_of(bodies, reducible))
    throw_scene_error("material",
                      "no material has a strength that a factor could divide; expected the law \"mohr-coulomb\" or "
                      "\"drucker-prager\"");
  if (!scene.solve.is_static() && !scene.stop.wants_equilibrium())
    throw_scene_error("stop",
                      "a factor of safety begins at an equilibrium, which this scene does not ask for; expected "
                      "stop.residual or stop.distance");
}

/// The factor to try next; empty: the bracket is narrow enough, or what is undecided keeps it from becoming so.
std::optional<double> next_factor(const SafetyStudy& study, const SafetyOptions& options) {
  if (!study.factor_low) return std::nullopt;
  const double low = *study.factor_low;
  if (!study.factor_high) {
    const bool tried =
        std::ranges::any_of(study.trials, [&](const SafetyTrial& one) { return one.factor >= options.to; });
    if (!tried) return options.to;
  }
  const double high = study.factor_high.value_or(options.to);
  if (low >= high || high - low <= options.width) return std::nullopt;
  // Between the bracket's ends and what is undecided between them
  std::vector<double> known = {low, high};
  for (const SafetyTrial& trial : study.trials)
    if (trial.verdict == SafetyVerdict::undecided && trial.factor > low && trial.factor < high)
      known.push_back(trial.factor);
  std::ranges::sort(known);
  const double above_low = known[1] - known[0], below_high = known.back() - known[known.size() - 2];
  constexpr double finest = 1.0 / 8;  // of the width
  if (std::max(above_low, below_high) <= finest * options.width) return std::nullopt;
  const double middle = (above_low >= below_high ? known[0] + known[1] : known.back() + known[known.size() - 2]) / 2;
  constexpr double digits = 1e12;  // what a halved decimal has beyond them is rounding
  return std::round(digits * middle) / digits;
}

void take(const SafetyTrial& trial, SafetyStudy& study) {
  study.trials.push_back(trial);
  if (trial.verdict == SafetyVerdict::rests)
    study.factor_low = std::max(study.factor_low.value_or(trial.factor), trial.factor);
  if (trial.verdict == SafetyVerdict::moves)
    study.factor_high = std::min(study.factor_high.value_or(trial.factor), trial.factor);
}

SafetyStudy bracket(const Scene& scene, const SafetyOptions& options) {
  check(scene);
  const Stopwatch wall;
  SafetyStudy study{.scene = scene.name,
                    .title = scene.title,
                    .scene_text = scene.text,
                    .overrides = scene.overrides,
                    .width = options.width};
  const int bisections = static_cast<int>(std::ceil(std::log2((options.to - options.from) / options.width)));
  const auto tell = [&](const std::string& doing) {
    const int done = static_cast<int>(study.trials.size());
    if (options.progress) options.progress({done, std::max(2 + bisections, done + 1), doing, wall.seconds()});
  };
  const auto is_interrupted = [&] { return options.interrupted && options.interrupted(); };
  tell(fmt::format("the equilibrium with the factor {:g}", options.from));
  ReducedBody body(scene, options);
  take(body.first(), study);
  study.notes = body.notes();
  if (scene.rubs())
    study.notes.emplace_back(
        "the friction and adhesion of rigid bodies and contacts are not divided by the factor: what slides along them "
        "may do so without a bracket; expected a thin layer of soil there, if its strength is to count");
  const StopScope scope(is_interrupted);
  try {
    for (auto factor = next_factor(study, options); factor && !is_interrupted(); factor = next_factor(study, options)) {
      tell(fmt::format("factor {:.4g}", *factor));
      const SafetyTrial trial = body.try_factor(*factor);
      if (is_interrupted() && trial.verdict == SafetyVerdict::undecided) break;
      take(trial, study);
      if (study.factor_high == trial.factor) study.mechanism = body.mechanism(trial.factor);
    }
  } catch (const Stopped&) {
  }
  study.interrupted = is_interrupted();
  study.wall_s = wall.seconds();
  return study;
}

}  // namespace

std::string SafetyOptions::validate() const {
  if (!(from > 0) || !std::isfinite(from)) return fmt::format("from: expected a factor above 0, found {}", from);
  if (!(to > from) || !std::isfinite(to)) return fmt::format("to: expected a factor above {:g}, found {}", from, to);
  if (!(width > 0)) return fmt::format("width: expected more than 0, found {}", width);
  return "";
}

std::string to_string(SafetyVerdict verdict) {
  switch (verdict) {
    case SafetyVerdict::rests:
      return "rests";
    case SafetyVerdict::moves:
      return "moves";
    default:
      return "undecided";
  }
}

bool SafetyStudy::is_found() const {
  constexpr double rounding = 1e-12;
  return factor_low && factor_high && *factor_high - *factor_low <= width * (1 + rounding);
}

SafetyStudy safety(const Scene& scene, const SafetyOptions& options) {
  if (const std::string wrong = options.validate(); !wrong.empty()) throw std::invalid_argument(wrong);
  return located(scene, [&] { return bracket(scene, options); });
}

}  // namespace stillpoint
