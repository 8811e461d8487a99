#include "study/observed_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/line_fit.hpp"
#include "base/special_functions.hpp"

namespace stillpoint {
namespace {

struct Range {
  std::size_t first, last;
  std::size_t levels() const { return last - first + 1; }
};

// The range of the finest consecutive levels that have an error greater than the solver's own.
std::optional<Range> with_errors(ConstVec errors, ConstVec floors) {
  const auto has = [&](std::size_t k) {
    return std::isfinite(errors[k]) && errors[k] > 0 && (floors.empty() || errors[k] > floors[k]);
  };
  std::size_t end = errors.size();
  while (end > 0 && !has(end - 1)) --end;
  std::size_t begin = end;
  while (begin > 0 && has(begin - 1)) --begin;
  if (end - begin < 2) return std::nullopt;
  return Range{begin, end - 1};
}

// The order from level k to the next.
double local_order(ConstVec sizes, ConstVec errors, std::size_t k) {
  return std::log(errors[k] / errors[k + 1]) / std::log(sizes[k] / sizes[k + 1]);
}

constexpr std::size_t fewest = 3;

// Leaves out fine levels at which another error, which is not refined, dominates, so that the error falls no more.
void leave_out_floor(ConstVec sizes, ConstVec errors, Range& range) {
  constexpr double falls_no_more = 0.5;  // relative to the steepest fall before
  while (range.levels() > fewest) {
    double steepest = 0;
    for (std::size_t k = range.first; k + 1 < range.last; ++k)
      steepest = std::max(steepest, local_order(sizes, errors, k));
    if (local_order(sizes, errors, range.last - 1) >= falls_no_more * steepest) return;
    --range.last;
  }
}

void leave_out_coarse(ConstVec sizes, ConstVec errors, Range& range) {
  constexpr double far = 0.3;
  const double last = local_order(sizes, errors, range.last - 1);
  while (range.levels() > fewest && std::abs(local_order(sizes, errors, range.first) - last) > far) ++range.first;
}

}  // namespace

// The slope over n levels has n − 2 degrees of freedom; 95 % of Student's distribution lie within ± t.
std::optional<ObservedOrder> observed_order(ConstVec sizes, ConstVec errors, ConstVec floors) {
  std::optional<Range> range = with_errors(errors, floors);
  if (!range) return std::nullopt;
  leave_out_floor(sizes, errors, *range);
  leave_out_coarse(sizes, errors, *range);
  std::vector<double> log_h, log_e;
  for (std::size_t k = range->first; k <= range->last; ++k) {
    log_h.push_back(std::log(sizes[k]));
    log_e.push_back(std::log(errors[k]));
  }
  const LineFit line = fit_line(log_h, log_e);
  ObservedOrder found{.order = line.slope, .first = range->first, .last = range->last};
  if (log_h.size() > 2) {
    const double t = student_quantile(0.975, static_cast<double>(log_h.size() - 2));
    found.low = line.slope - t * std::sqrt(line.slope_variance);
    found.high = line.slope + t * std::sqrt(line.slope_variance);
  }
  return found;
}

std::vector<double> differences(ConstVec values) {
  std::vector<double> found(values.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k + 1 < values.size(); ++k) found[k] = std::abs(values[k] - values[k + 1]);
  return found;
}

double extrapolated(double coarse, double fine, double ratio, double order) {
  return fine + (fine - coarse) / (std::pow(ratio, order) - 1);
}

}  // namespace stillpoint
