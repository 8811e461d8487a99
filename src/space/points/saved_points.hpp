// Saving and restoring points, and a check that the restored ones are in an order that loops over them can take.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <string>
#include <vector>

#include "space/points/material_points.hpp"

namespace stillpoint {

template <int Dim>
void archive_points(const StateArchive& state, MaterialPoints<Dim>& points);
/// Saves or restores the number of points, which grows where domains are halved. If the restored number differs,
/// replaces each point by a copy of one of the same material, whose law it takes, and returns the former number of
/// each; the data of the points are restored with the rest.
template <int Dim>
std::vector<int> archive_number_of_points(const StateArchive& state, MaterialPoints<Dim>& points);

/// The fault by which a loop would leave these points in a grid of `cells`, or by which the numbers of points are not 0
/// … numbers − 1 with at least one point each; empty: none.
template <int Dim>
std::string disorder_of(const MaterialPoints<Dim>& points, long cells, std::size_t numbers);

}  // namespace stillpoint
