// The moduli of a point for any tangent of the phase.
#pragma once

#include "linalg/positive_part.hpp"
#include "space/materials/point_material.hpp"

namespace stillpoint {

/// The moduli of the law, as PointMaterial::moduli(); for Tangent::stable the positive semi-definite part of the
/// elastic ones.
template <Kinematics K>
typename PointMaterial<K>::ModuliMatrix moduli_of(const PointMaterial<K>& law, Tangent kind, const TensorOf<K>& H,
                                                  const TensorOf<K>& dH, double dt, std::size_t p) {
  if (kind != Tangent::stable) return law.moduli(kind, H, dH, dt, p);
  auto A = law.moduli(Tangent::elastic, H, dH, dt, p);
  take_positive_part(A);
  return A;
}

}  // namespace stillpoint
