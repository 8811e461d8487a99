// Where frequencies are estimated in another way.
#pragma once

#include <cstddef>

namespace stillpoint {

/// Unknowns above which a factor of K, or hundreds of products with it, cost more than many a relaxation.
constexpr std::size_t direct_solver_limit = 20'000;

}  // namespace stillpoint
