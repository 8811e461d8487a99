// A place in the body that one of the ranks knows, for all of them.
#pragma once

#include <stillpoint/place_in_body.hpp>

#include "parallel/of_all.hpp"

namespace stillpoint {

/// The place of the first rank that knows it; a place without words is not known.
PlaceInBody place_of_ranks(const Ranks* ranks, const PlaceInBody& mine);

}  // namespace stillpoint
