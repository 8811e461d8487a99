// What the water in the pores of an undrained material does to its stiffness.
#pragma once

#include <stillpoint/problem.hpp>

namespace stillpoint {

/// K_w/n of an undrained material [Pa]: that of its water or, without one, such that the undrained Poisson's ratio is
/// 0.495. Without one the law has to have E.
double water_stiffness(const MaterialSpec& material);

/// Whether a material's law has these parameters.
bool has_E_and_nu(const MaterialSpec& material);

/// Young's modulus [Pa] and Poisson's ratio of a material that has them, with its water: how it resists small strains.
struct YoungPoisson {
  double E, nu;
};
YoungPoisson with_water(const MaterialSpec& material);

}  // namespace stillpoint
