// The stress of points of viscous materials beyond their strength: over_stress() of a phase.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

// Where the strength is next to nothing, as at a free surface of ground without cohesion, a hundredth of the largest
// √J₂ takes its place.
template <AxisBasis B, Kinematics K>
std::optional<OverStress> MaterialPointPhase<B, K>::over_stress() const {
  constexpr double next_to_none = 0.01;
  const auto for_viscous = [&](const auto& visit) {
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      if (material_of(k).info().viscous) visit(*material_of(k).yield_state(p), number);
    });
  };
  bool found = false;
  double largest = 0;
  for_viscous([&](const YieldState& at, std::size_t) {
    found = true;
    largest = std::max(largest, at.root_J2);
  });
  if (!found) return std::nullopt;
  OverStress worst{.share = -std::numeric_limits<double>::infinity()};
  for_viscous([&](const YieldState& at, std::size_t number) {
    const double strength = std::max(at.strength, next_to_none * largest);
    const double share = at.f == 0 ? 0 : at.f / strength;
    if (!std::isnan(worst.share) && !(share <= worst.share)) worst = {share, number};
  });
  return worst;
}

}  // namespace stillpoint
