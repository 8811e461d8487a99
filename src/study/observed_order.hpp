// The order of an error: e = C h^p by least squares in the logarithms, over the levels at which that holds.
#pragma once

#include <stillpoint/converge.hpp>
#include <stillpoint/types.hpp>

#include <optional>
#include <vector>

namespace stillpoint {

/// sizes: those of the levels, each smaller than the one before; errors: one for each level, NaN if there is none,
/// (levels) both. Left out are coarse levels whose order from one to the next is still far from that of the last, and
/// fine ones whose error has ceased to fall, as long as three are left. floors: the part of each error that is due to
/// rounding or to the solver, (levels); levels whose error is no greater are left out. Empty if fewer than two levels
/// have an error above 0 and above its floor.
std::optional<ObservedOrder> observed_order(ConstVec sizes, ConstVec errors, ConstVec floors = {});

/// The differences |q_k − q_{k+1}| of values q_k = q + C h_k^p, as many as levels, the last NaN. If sizes fall by a
/// constant ratio they fall like the error, and q need not be known.
std::vector<double> differences(ConstVec values);

/// q by Richardson's extrapolation from the two finest levels, whose sizes have this ratio.
double extrapolated(double coarse, double fine, double ratio, double order);

}  // namespace stillpoint
