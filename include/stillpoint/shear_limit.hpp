// How much shear stress what touches bears, |τ| ≤ c + μ p.
#pragma once

#include <cmath>

namespace stillpoint {

struct ShearLimit {
  double friction = 0;  // μ, Coulomb's coefficient; infinite: rough
  double adhesion = 0;  // c, borne besides as long as it is pressed together [Pa]

  /// Whether there is any.
  bool acts() const { return friction > 0 || adhesion > 0; }
  /// Whether it can be used up.
  bool ends() const { return acts() && std::isfinite(friction); }
  /// c + μ p, and 0 where there is no pressure p [Pa].
  double at(double p) const { return p > 0 ? adhesion + friction * p : 0; }
};

}  // namespace stillpoint
