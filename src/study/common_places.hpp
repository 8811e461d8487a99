// Places at which levels with different points are compared.
#pragma once

#include <stillpoint/problem.hpp>

#include <vector>

#include "space/phase/place_reader.hpp"

namespace stillpoint {

/// Places in the body at the start.
struct CommonPlaces {
  std::vector<double> x;       // (places × dim) [m]
  std::vector<double> volume;  // volume that each place stands for [m³]
  std::size_t size() const { return volume.size(); }
};

/// Two places along each axis of every cell of the scene's grid, at Gauss–Legendre positions: in the cells of a coarser
/// level they lie at many positions, and nowhere on a node, at which a displacement may be far better than elsewhere.
/// For a body from a file, its points.
CommonPlaces common_places(const Problem& problem);
/// An upper bound of their number.
double count_of_places(const Problem& problem);

/// u and stress at the places, (places × dim) and (places × components); NaN where they cannot be read.
struct FieldsAtPlaces {
  std::vector<double> u, stress;
};
FieldsAtPlaces read_at(const CommonPlaces& places, const PlaceReader& reader, std::size_t stress_components);

}  // namespace stillpoint
