#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "scene/formula_parts.hpp"
#include "simulation/loads/formula_samples.hpp"

namespace stillpoint {
namespace {

constexpr double golden = 0.6180339887498949;  // its multiples fill an interval without a period

// A part of the formula, if it depends on t and is a formula by itself.
std::optional<Expression> part_of(const Expression& formula, const std::string& text) {
  try {
    Expression part = formula.with_text(text);
    if (part.uses('t')) return part;
  } catch (const ExpressionError&) {
  }
  return std::nullopt;
}

std::vector<Expression> switching_parts(const Expression& formula) {
  constexpr std::size_t largest_count = 48;
  std::vector<Expression> parts;
  const auto add = [&](const std::string& text) {
    if (parts.size() >= largest_count) return;
    if (auto part = part_of(formula, text)) parts.push_back(std::move(*part));
  };
  for (const FormulaComparison& comparison : comparisons_in(formula.text())) add(comparison.difference);
  for (const std::string& argument : arguments_in(formula.text())) add(argument);
  return parts;
}

std::vector<double> raster(int moments, double end) {
  std::vector<double> times;
  for (int k = 0; k < moments; ++k) {
    const double share = golden * (k + 1);
    times.push_back(end * k / moments);
    times.push_back(end * (k + 0.02 + 0.96 * (share - std::floor(share))) / moments);
  }
  times.push_back(end);
  return times;
}

/// The moments at which a part vanishes, or comes nearest to that.
class Zeros {
 public:
  Zeros(const Expression& part, ConstVec x, std::vector<double>& found)
      : part_(part), x_(x), found_(found), most_(found.size() + 2000) {}

  void look(ConstVec times) {
    if (times.size() < 3) return;
    double last_but_one = value(times[0]), last = value(times[1]);
    between(times[0], times[1], last_but_one, last);
    for (std::size_t k = 2; k < times.size() && found_.size() < most_; ++k) {
      const double now = value(times[k]);
      between(times[k - 1], times[k], last, now);
      const bool same_side = (last > 0) == (now > 0) && (last > 0) == (last_but_one > 0);
      const bool nearest = std::abs(last) < std::abs(last_but_one) && std::abs(last) <= std::abs(now);
      if (same_side && nearest) near(times[k - 2], times[k], last > 0);
      last_but_one = last;
      last = now;
    }
  }

 private:
  double value(double t) const { return part_(x_, t); }

  void between(double a, double b, double at_a, double at_b) {
    if (at_b == 0) found_.push_back(b);
    if (!((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0))) return;
    for (int halving = 0; halving < 60 && a < b; ++halving) {
      const double middle = a + (b - a) / 2;
      if (middle <= a || middle >= b) break;
      ((value(middle) > 0) == (at_a > 0) ? a : b) = middle;
    }
    found_.push_back(a);
    found_.push_back(b);
  }

  // Golden section on |part|, until it is on the other side.
  void near(double a, double b, bool above) {
    const double begin = a, end = b;
    const auto distance = [&](double t) { return above ? value(t) : -value(t); };
    double c = b - golden * (b - a), d = a + golden * (b - a), at_c = distance(c), at_d = distance(d);
    for (int k = 0; k < 50 && at_c > 0 && at_d > 0; ++k) {
      if (at_c < at_d) {
        b = d, d = c, at_d = at_c;
        at_c = distance(c = b - golden * (b - a));
      } else {
        a = c, c = d, at_c = at_d;
        at_d = distance(d = a + golden * (b - a));
      }
    }
    const double lowest = at_c < at_d ? c : d;
    found_.push_back(lowest);
    between(begin, lowest, value(begin), value(lowest));
    between(lowest, end, value(lowest), value(end));
  }

  const Expression& part_;
  ConstVec x_;
  std::vector<double>& found_;
  std::size_t most_;  // the largest number of moments to be found, those of the parts before included
};

// All times in order, with the middles between the moments found and their neighbours.
std::vector<double> merged(std::vector<double> times, std::vector<double> found) {
  const auto sort = [](std::vector<double>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  sort(found);
  std::vector<double> all = std::move(times);
  all.insert(all.end(), found.begin(), found.end());
  std::ranges::sort(all);
  std::vector<double> middles;
  for (const double moment : found) {
    const auto at = std::ranges::lower_bound(all, moment);
    if (at != all.begin()) middles.push_back((*(at - 1) + moment) / 2);
    const auto after = std::ranges::upper_bound(all, moment);
    if (after != all.end()) middles.push_back((*after + moment) / 2);
  }
  all.insert(all.end(), middles.begin(), middles.end());
  sort(all);
  return all;
}

// True if the part goes up and down from one moment to the next.
bool is_unresolved(const Expression& part, ConstVec x, ConstVec times) {
  constexpr double largest_share = 0.3;  // share of the moments at which it turns
  double turns = 0, last = 0, before = part(x, times.front());
  for (const double t : times) {
    const double now = part(x, t), change = now - before;
    if (change * last < 0) ++turns;
    if (change != 0) last = change;
    before = now;
  }
  return turns > largest_share * static_cast<double>(times.size());
}

}  // namespace

std::vector<double> moments_of_change(const Expression& formula, ConstVec x, int moments, double end) {
  const std::vector<Expression> parts = switching_parts(formula);
  constexpr int fewest = 100, of_parts = 10;
  const std::vector<double> coarse = raster(std::max(std::min(fewest, moments), moments / of_parts), end);
  std::vector<double> found;
  // A moment that one part tells may be one at which another part has to be looked at.
  for (int round = 0; round < 2 && !parts.empty(); ++round) {
    const std::vector<double> times = merged(coarse, found);
    found.clear();
    for (const Expression& part : parts) Zeros(part, x, found).look(times);
    std::erase_if(found, [&](double t) { return !(t >= 0 && t <= end); });
  }
  return merged(raster(moments, end), std::move(found));
}

std::optional<double> open_end(const Expression& formula, ConstVec x) {
  constexpr int decades = 21, a_decade = 40;
  constexpr double latest_share = 1e-3;  // share of the last moment: what bends later may as well go on for ever
  std::vector<double> times{0};
  for (int k = 0; k <= decades * a_decade; ++k) times.push_back(std::pow(10.0, -9 + k / double{a_decade}));
  std::vector<double> found;
  for (const Expression& part : switching_parts(formula)) Zeros(part, x, found).look(times);
  times = merged(std::move(times), std::move(found));
  std::vector<double> values;
  for (const double t : times) values.push_back(formula(x, t));
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) return std::nullopt;
  std::size_t last = times.size() - 1;
  while (last > 0 && values[last - 1] == values.back()) --last;
  if (times[last] > latest_share * times.back()) return std::nullopt;
  return 2 * times[last];
}

double unresolved_until(const Expression& formula, ConstVec x, ConstVec times, double same) {
  double until = 0;
  for (const FormulaComparison& comparison : comparisons_in(formula.text())) {
    const std::optional<Expression> difference = part_of(formula, comparison.difference);
    if (!difference || !is_unresolved(*difference, x, times)) continue;
    const auto with = [&](const char* value) {
      std::string text = formula.text();
      return formula.with_text(text.replace(comparison.begin, comparison.end - comparison.begin, value));
    };
    const Expression no = with("(0)"), yes = with("(1)");
    std::size_t k = times.size();
    while (k > 0 && std::abs(no(x, times[k - 1]) - yes(x, times[k - 1])) <= same) --k;
    if (k > 0) until = std::max(until, times[std::min(k, times.size() - 1)]);
  }
  return until;
}

}  // namespace stillpoint
