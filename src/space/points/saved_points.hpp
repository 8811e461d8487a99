// Points as they are saved and restored, and whether they are then in an order that loops over them can take.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <string>
#include <vector>

#include "space/points/material_points.hpp"

namespace stillpoint {

template <int Dim>
void archive_points(const StateArchive& state, MaterialPoints<Dim>& points);
/// Domains that were halved are more than there were when the body was placed. Where other points are restored than
/// there are: for each of them one of the same material, whose law it takes; what they are is restored with the rest.
template <int Dim>
std::vector<int> archive_number_of_points(const StateArchive& state, MaterialPoints<Dim>& points);

/// What would send a loop elsewhere than to these points in a grid of `cells`, or to other numbers than 0 … numbers −
/// 1, of which each has a point at least; empty: nothing does.
template <int Dim>
std::string disorder_of(const MaterialPoints<Dim>& points, long cells, std::size_t numbers);

}  // namespace stillpoint
