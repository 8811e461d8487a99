// The bodies of a phase: which of them the grid moves as one, and which something holds.
#pragma once

#include "space/phase/body_neighbours.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
std::vector<BodyGap> MaterialPointPhase<B, K>::body_gaps() const {
  if (scene_.bodies.size() < 2) return {};
  return BodyNeighbours<B, K>(scene_, grid_, body_.points, weights_, body_.first_number).find(phase_ == 0);
}

template <AxisBasis B, Kinematics K>
std::vector<char> MaterialPointPhase<B, K>::held_bodies() const {
  std::vector<char> held(scene_.bodies.size(), 0);
  std::vector<char> is_held(reached_.size(), 0);  // a function, by a support, a wall or a spring
  for (std::size_t f = 0; f < is_held.size(); ++f) is_held[f] = !untouched_[f];
  for (const Springs::Weight& weight : weak_supports_.springs().weights())
    is_held[static_cast<std::size_t>(weight.unknown / Dim)] = 1;
  const auto bodies =
      BodyNeighbours<B, K>(scene_, grid_, body_.points, weights_, body_.first_number).bodies_of_functions();
  for (std::size_t f = 0; f < bodies.size(); ++f)
    for (const std::size_t body : bodies[f])
      if (is_held[f]) held[body] = 1;
  return held;
}

}  // namespace stillpoint
