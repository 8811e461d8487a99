// Fields of motion: bodies between which a scene has a [[contact]] move by functions of their own on the same grid, so
// that each may go its own way where both reach a function.
//
// All other bodies are bonded where they share functions, and so are in one field. There are as few fields as that
// leaves: 1 without contacts, mostly 2 with them.
#pragma once

#include <stillpoint/problem.hpp>

#include <vector>

#include "space/points/material_points.hpp"

namespace stillpoint {

struct MotionFields {
  std::vector<int> of_body;  // (bodies)
  int count = 1;
};

/// points: those of each body, (bodies). Throws SceneError if bodies of a contact are bonded through another one.
template <int Dim>
MotionFields motion_fields(const Problem& problem, const Grid<Dim>& grid,
                           const std::vector<MaterialPoints<Dim>>& points);

}  // namespace stillpoint
