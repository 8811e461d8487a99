// The place in a body at which a nodal quantity is largest, for messages about failures.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <string>

namespace stillpoint {

/// The index of the largest |x_k|, or of the first that is NaN; x: not empty.
std::size_t largest_entry(ConstVec x);

/// "the node at (1, 0.5) beside material point 12 in cell (3, 1)" for the place at which x, (n), is largest; x may
/// contain NaN. "no degree of freedom" for a system that has none.
std::string largest_at(const SemiDiscrete& system, ConstVec x);

/// The place to report for a motion that is no longer finite: that at which the last good state moves fastest or, at
/// rest, at which the new one is first not finite; (2n) each.
std::string divergence_at(const SemiDiscrete& system, ConstVec last_good, ConstVec y);

}  // namespace stillpoint
