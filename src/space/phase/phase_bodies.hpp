// The bodies of a phase: those that the grid moves as one, and those that are held.
#pragma once

#include "space/phase/body_neighbours.hpp"
#include "space/phase/material_point_phase.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
std::vector<BodyGap> MaterialPointPhase<B, K>::body_gaps() const {
  if (problem_.bodies.size() < 2) return {};
  return BodyNeighbours<Dim>(problem_, functions_, body_.points, weights_, body_.first_number).find(phase_ == 0);
}

template <AxisBasis B, Kinematics K>
std::vector<HeldAxes> MaterialPointPhase<B, K>::held_bodies() const {
  std::vector<HeldAxes> held(problem_.bodies.size(), HeldAxes{});
  const std::vector<char> is_sprung = conditions_.are_sprung(Dim * reached_.size());
  const auto bodies =
      BodyNeighbours<Dim>(problem_, functions_, body_.points, weights_, body_.first_number).bodies_of_functions();
  for (std::size_t f = 0; f < bodies.size(); ++f) {
    for (std::size_t axis = 0; axis < Dim; ++axis) {
      const auto unknown = static_cast<int>(Dim * f + axis);
      if (!held_.is_prescribed(unknown) && !held_.is_guided(unknown) && !is_sprung[Dim * f + axis]) continue;
      for (const std::size_t body : bodies[f]) held[body][axis] = true;
    }
  }
  return held;
}

}  // namespace stillpoint
