#include "simulation/loads/load_schedule.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "scene/own_loads.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/loads/formula_samples.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t moments_of_a_course = 8;
using Moments = std::array<double, moments_of_a_course>;
using Course = std::array<std::uint64_t, moments_of_a_course>;  // the bits of a formula's values at these moments

/// Some moments up to the end; if that is open, they are of all orders of magnitude.
Moments some_moments(double end) {
  constexpr double golden = 0.6180339887498949;  // its multiples fill an interval without a period
  Moments moments;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const double share = golden * static_cast<double>(k + 1);
    moments[k] = end > 0 ? end * (share - std::floor(share)) : std::pow(10.0, -4 + 1.3 * static_cast<double>(k));
  }
  return moments;
}

/// Positions out of (points × dim) at which the formula has different courses in time: one for each course, but no more
/// than 32.
std::vector<ConstVec> positions_of_courses(const Expression& formula, ConstVec positions, std::size_t dim, double end) {
  constexpr std::size_t largest_sample = 100'000, largest_choice = 32;  // [points]
  const Moments moments = some_moments(end);
  const std::size_t points = positions.size() / dim;
  std::set<Course> seen;
  std::vector<ConstVec> found;
  for (std::size_t p = 0; p < points; p += (points + largest_sample - 1) / largest_sample) {
    const ConstVec x = positions.subspan(dim * p, dim);
    Course course;
    std::ranges::transform(moments, course.begin(),
                           [&](double t) { return std::bit_cast<std::uint64_t>(formula(x, t)); });
    if (seen.insert(course).second) found.push_back(x);
  }
  if (found.size() <= largest_choice) return found;
  std::vector<ConstVec> some;
  for (std::size_t k = 0; k < largest_choice; ++k) some.push_back(found[k * (found.size() - 1) / (largest_choice - 1)]);
  return some;
}

}  // namespace

std::vector<double> total_load_at(const SemiDiscrete& system, double t) {
  const std::vector<double> rest(system.size(), 0.0);
  std::vector<double> Q(system.size()), R(system.size());
  system.external_force(t, rest, Q);
  system.internal_force(t, rest, R, *system.make_trial());
  for (std::size_t i = 0; i < Q.size(); ++i) Q[i] -= R[i];
  return Q;
}

LoadSchedule::LoadSchedule(const Problem& problem, const LagrangianPhase& phase, double end) {
  own_ = own_load(problem.own_load);
  if (own_) look_at_own(problem, phase, end);
  // All formulas that vary are looked at closely, unless there are more than a thousand.
  long varying = 0;
  problem.for_each_formula([&](const std::string&, const Expression& formula) { varying += formula.uses('t'); });
  const int share = static_cast<int>(std::max(1L, varying / 1000));
  const int moments = std::max(20'000 / share, 100), moments_at_a_point = std::max(2'000 / share, 100);
  const auto dim = static_cast<std::size_t>(problem.dim);
  problem.for_each_formula([&](const std::string& key, const Expression& formula) {
    if (!formula.uses('t')) return;
    if (!formula.uses_position()) return look_at(key, formula, {}, moments, end);
    const std::vector<double> positions = formula_positions(problem, phase, key);
    for (const ConstVec x : positions_of_courses(formula, positions, dim, end))
      look_at(key, formula, x, moments_at_a_point, end);
  });
}

// A program says itself when its load has settled. It is taken at its word, but for a few moments afterwards.
void LoadSchedule::look_at_own(const Problem& problem, const LagrangianPhase& phase, double end) {
  const double settles_at = own_->about.settles_at;
  is_open_ = !(end > 0) && std::isinf(settles_at);
  if (!is_open_) settled_from_ = end > 0 ? std::min(settles_at, end) : settles_at;
  if (!(settles_at < (end > 0 ? end : std::numeric_limits<double>::infinity()))) return;
  dim_ = problem.dim;
  x_ = phase.fields().positions();
  b_settled_.resize(x_.size());
  own_->b(settles_at, dim_, x_, b_settled_);
  constexpr double span = 1e3;  // [s], if there is no end
  for (const double share : {1e-6, 1e-3, 0.0618, 0.382, 0.7639, 1.0}) {
    const double t = settles_at + share * (end > 0 ? end - settles_at : span);
    if (const std::string wrong = own_load_goes_on(t); !wrong.empty()) throw_scene_error("body_force.own", wrong);
  }
}

std::string LoadSchedule::own_load_goes_on(double t) const {
  if (b_settled_.empty() || t < own_->about.settles_at) return "";
  std::vector<double> b(x_.size());
  own_->b(t, dim_, x_, b);
  double change = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!std::isfinite(b[i]) || !std::isfinite(b_settled_[i])) return "";  // the step reports this
    change = std::max(change, std::abs(b[i] - b_settled_[i]));
    size = std::max({size, std::abs(b[i]), std::abs(b_settled_[i])});
  }
  constexpr double tolerance = 1e-9;  // relative
  if (change <= tolerance * size) return "";
  return fmt::format(
      "the load '{0}' is said to settle at t = {1:.6g}, and is another one at t = {2:.6g}, by up to {3:.3g} m/s2; "
      "expected settles_at = the time from which on it stays, or infinity",
      own_->about.name, own_->about.settles_at, t, change);
}

void LoadSchedule::look_at(const std::string& key, const Expression& formula, ConstVec x, int moments, double end) {
  if (!(end > 0)) {
    const std::optional<double> found = open_end(formula, x);
    is_open_ = is_open_ || !found;
    if (!found || *found == 0) return;
    end = *found;
  }
  const std::vector<double> times = moments_of_change(formula, x, moments / 2, end);
  std::vector<double> values;
  for (const double t : times) {
    values.push_back(formula(x, t));
    if (!std::isfinite(values.back()))
      throw_scene_error(
          key, fmt::format("the formula is {} at t = {:.6g}; expected a finite number until stop.time = {:.6g}",
                           std::isnan(values.back()) ? "not a number" : "infinite", t, end));
  }
  const auto [least, most] = std::ranges::minmax(values);
  const double magnitude = std::max(std::abs(least), std::abs(most));
  const double same = 1e-9 * (most - least) + 1e-14 * magnitude;  // a change that does not count, and rounding
  settled_from_ = std::max(settled_from_, unresolved_until(formula, x, times, same));
  std::size_t last = times.size() - 1;  // the first moment from which on the formula is what it will be at the end
  while (last > 0 && std::abs(values[last - 1] - values.back()) <= same) --last;
  if (last == 0) return;
  double before = times[last - 1], from = times[last];
  for (int halving = 0; halving < 30; ++halving) {
    const double middle = (before + from) / 2;
    (std::abs(formula(x, middle) - values.back()) <= same ? from : before) = middle;
  }
  settled_from_ = std::max(settled_from_, from);
}

}  // namespace stillpoint
