// The moments at which a formula of t has to be looked at, so that no pulse of it is missed.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/types.hpp>

#include <vector>

namespace stillpoint {

/// Of the formula at x from 0 to end [s]: `moments` evenly spaced ones, as many off that raster, whose period a formula
/// may have, and those at which one of its comparisons switches or one of its functions may bend, with what lies
/// between any two of these. In order; 0 and end are among them.
std::vector<double> moments_of_change(const Expression& formula, ConstVec x, int moments, double end);

/// The first moment from which on the formula does not depend on a comparison that switches more often than `times`,
/// those of moments_of_change(), can tell; 0 if it has none, end if it depends on it to the end.
double unresolved_until(const Expression& formula, ConstVec x, ConstVec times, double same);

}  // namespace stillpoint
