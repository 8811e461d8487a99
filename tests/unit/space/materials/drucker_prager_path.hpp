// A material point of Drucker–Prager soil on a path of strain, and the invariants of its stress.
#pragma once

#include <stillpoint/drucker_prager.hpp>

#include <cmath>

#include "law_checks.hpp"
#include "space/materials/history_path.hpp"

namespace stillpoint::test {

using enum StressState;

using checks::one_degree;
constexpr double ground_E = 1e7, ground_nu = 0.2, ground_G = ground_E / (2 * (1 + ground_nu)),
                 ground_K = ground_E / (3 * (1 - 2 * ground_nu));

/// varies: of a soil that softens.
template <StressState S, bool varies = false>
using Path = HistoryPath<DruckerPrager<S, varies>, DruckerPragerParameters>;

inline double pressure(const Stress<plane_strain>& s) { return (s[0] + s[1] + s[2]) / 3; }  // p, tension positive
inline double root_J2(const Stress<plane_strain>& s) {
  const double p = pressure(s), x = s[0] - p, y = s[1] - p, z = s[2] - p;
  return std::sqrt((x * x + y * y + z * z) / 2 + s[3] * s[3]);
}
template <StressState S, bool varies>
double p_of(const Path<S, varies>& path) {
  return pressure(path.law.cauchy(path.now));
}
template <StressState S, bool varies>
double root_J2_of(const Path<S, varies>& path) {
  return root_J2(path.law.cauchy(path.now));
}

}  // namespace stillpoint::test
