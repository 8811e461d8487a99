// The size of system above which frequencies are estimated without a direct solver.
#pragma once

#include <cstddef>

namespace stillpoint {

/// The number of unknowns above which a factor of K, or hundreds of products with it, cost more than many a relaxation.
constexpr std::size_t direct_solver_limit = 20'000;

}  // namespace stillpoint
