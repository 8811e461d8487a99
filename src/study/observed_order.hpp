// The order of an error: e = C h^p by least squares in the logarithms, over the levels where that is so.
#pragma once

#include <stillpoint/converge.hpp>
#include <stillpoint/types.hpp>

#include <optional>
#include <vector>

namespace stillpoint {

/// sizes: of the levels, each smaller than the one before; errors: of each, NaN if there is none, (levels) both. Left
/// out are coarse levels whose order from one to the next is still far from that of the last, and fine ones whose error
/// has ceased to fall, as long as three are left. floors: what of an error is rounding, or what a solver has left of
/// it, (levels); levels with no more than that are left out. Empty if fewer than two have an error above 0 and its
/// floor.
std::optional<ObservedOrder> observed_order(ConstVec sizes, ConstVec errors, ConstVec floors = {});

/// What is left of a value q_k = q + C h_k^p, if sizes fall by a constant ratio: |q_k − q_{k+1}|, as many as levels,
/// the last NaN. It falls like the error, without knowing q.
std::vector<double> differences(ConstVec values);

/// q by Richardson's extrapolation from the two finest levels of a ratio.
double extrapolated(double coarse, double fine, double ratio, double order);

}  // namespace stillpoint
