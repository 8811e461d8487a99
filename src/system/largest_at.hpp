// Where in a body a quantity of its degrees of freedom is largest: what a failure is told by.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <string>

namespace stillpoint {

/// The index of the largest |x_k|, or of the first that is not a number; x: not empty.
std::size_t largest_entry(ConstVec x);

/// "the node at (1, 0.5) beside material point 12 in cell (3, 1)", where x, (n), is largest; x may hold no number.
/// "no degree of freedom" of a system that has none.
std::string largest_at(const SemiDiscrete& system, ConstVec x);

/// What to say of a motion that is no longer finite: where the last good state moves fastest or, at rest, where the
/// new one, (2n) each, is first not finite.
std::string divergence_at(const SemiDiscrete& system, ConstVec last_good, ConstVec y);

}  // namespace stillpoint
