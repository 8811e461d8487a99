// Whether points that were restored are in an order that loops over them can take.
#pragma once

#include <string>

#include "space/points/material_points.hpp"

namespace stillpoint {

/// What would send a loop elsewhere than to these points in a grid of `cells`, or to other numbers than 0 … numbers −
/// 1, of which each has a point at least; empty: nothing does.
template <int Dim>
std::string disorder_of(const MaterialPoints<Dim>& points, long cells, std::size_t numbers);

}  // namespace stillpoint
