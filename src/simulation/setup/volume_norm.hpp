// The distance between displacements, by the volume of the body that is displaced:
//
//   ‖u‖_V² = ∫ |u|² dV,   V the mass matrix of density 1
//
// The M-norm is as good if all of the body has the same density, see mass_measures_volume(). Otherwise it overlooks
// what is light; and if the mass is scaled by the stiffness, what is soft.
#pragma once

#include <stillpoint/mass.hpp>

namespace stillpoint {

struct VolumeNorm {
  Mass V;              // (n × n) [m³]
  double omega_1 = 0;  // ω₁² the lowest eigenvalue of K x = ω² V x
};

}  // namespace stillpoint
