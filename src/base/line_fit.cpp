#include "base/line_fit.hpp"

#include <cstddef>
#include <numeric>

namespace stillpoint {
namespace {

double mean(ConstVec values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

// Computed from deviations from the means, which keeps the digits of points far from 0.
LineFit fit_line(ConstVec x, ConstVec y) {
  const double middle_x = mean(x), middle_y = mean(y);
  double xx = 0, xy = 0, squares = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - middle_x) * (x[k] - middle_x);
    xy += (x[k] - middle_x) * (y[k] - middle_y);
  }
  const double slope = xy / xx;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = y[k] - middle_y - slope * (x[k] - middle_x);
    squares += off * off;
  }
  return {middle_y - slope * middle_x, slope, squares / ((static_cast<double>(x.size()) - 2) * xx)};
}

}  // namespace stillpoint
