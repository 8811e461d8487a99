// The reduction of the strength of materials by a factor F [Zienkiewicz, Humpheson and Lewis 1975]:
//   c/F,   tan φ/F,   σ_t/F,   ψ no larger than the reduced φ.
#pragma once

#include <stillpoint/problem.hpp>

namespace stillpoint {

/// Whether a law's strength has names that a factor can reduce.
bool has_reducible_strength(const MaterialSpec& material);

MaterialSpec with_strength_over(MaterialSpec material, double factor);
Problem with_strength_over(Problem problem, double factor);

}  // namespace stillpoint
