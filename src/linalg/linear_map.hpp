// A linear operator, given by its action on a vector.
#pragma once

#include <stillpoint/types.hpp>

#include <functional>

namespace stillpoint {

/// y = A x or y = B⁻¹ x; x, y: (n), distinct.
using LinearMap = std::function<void(ConstVec x, Vec y)>;

}  // namespace stillpoint
