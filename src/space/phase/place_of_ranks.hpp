// A place in the body that one of the ranks knows, for all of them.
#pragma once

#include <stillpoint/place_in_body.hpp>

#include "space/kernels/shared_corners.hpp"

namespace stillpoint {

/// The place in the cell that comes first, of those that ranks know; a place without words is not known.
PlaceInBody place_of_ranks(const Ranks* ranks, const PlaceInBody& mine, const CellPlace& cell);

}  // namespace stillpoint
