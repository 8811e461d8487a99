#include "system/largest_at.hpp"

#include <stillpoint/vector.hpp>

#include <cmath>

#include <fmt/format.h>

namespace stillpoint {

std::size_t largest_entry(ConstVec x) {
  std::size_t largest = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (std::isnan(x[k])) return k;
    if (std::abs(x[k]) > std::abs(x[largest])) largest = k;
  }
  return largest;
}

std::string largest_at(const SemiDiscrete& system, ConstVec x) {
  if (x.empty()) return "no degree of freedom";
  return to_string(system.diagnosis().of_unknown(largest_entry(x)));
}

std::string divergence_at(const SemiDiscrete& system, ConstVec last_good, ConstVec y) {
  const ConstVec v = second_half(last_good);
  const double fastest = v.empty() ? 0 : std::abs(v[largest_entry(v)]);
  if (fastest > 0)
    return fmt::format("the motion before was fastest, {:.3g} m/s, at {}", fastest, largest_at(system, v));
  for (const ConstVec half : {first_half(y), second_half(y)}) {
    for (std::size_t k = 0; k < half.size(); ++k) {
      if (!std::isfinite(half[k])) return "it is not at " + to_string(system.diagnosis().of_unknown(k));
    }
  }
  return "it has grown beyond all numbers";
}

}  // namespace stillpoint
