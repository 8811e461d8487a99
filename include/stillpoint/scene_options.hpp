// The options of a scene that are words: an enumeration for each.
#pragma once

#include <string_view>

namespace stillpoint {

enum class BasisKind { linear, quadratic, cubic, hermite };
/// The degree of the basis's polynomials; a cell has one function more than that along an axis.
constexpr int degree_of(BasisKind basis) {
  return basis == BasisKind::linear ? 1 : basis == BasisKind::quadratic ? 2 : 3;
}
/// The assumption on the directions that are not computed: the first two states are for one dimension, the next three
/// for two; in space all directions are computed. The coordinates of an axisymmetric scene are the radius r and the
/// axis z.
enum class StressState { uniaxial_stress, uniaxial_strain, plane_strain, plane_stress, axisymmetric, space };
/// The state's name in scenes: "plane-strain".
std::string_view to_string(StressState state);
/// The shape of a body, by the keys that its table has.
enum class BodyShape { box, points, polygon, sphere, cylinder, triangles };
enum class Placement { uniform, gauss, random };
enum class VolumeRule { equal, consistent };
/// multigrid: fictitious, M⁻¹ one cycle of multigrid on the elastic stiffness.
enum class MassKind { consistent, lumped, multigrid };
enum class MassScaling { uniform, gershgorin };
enum class Transfer { flip, pic, apic, xpic };
/// The source of the deformation of an elastic point when a phase begins.
enum class DeformationRule {
  positions,   // F = (∂X/∂x)⁻¹ of the undeformed positions X fitted over the present ones
  accumulated  // F = f F, from phase to phase
};
/// The region that a material point of a body that moves on represents in the sums over points.
enum class Quadrature {
  points,  // itself: N_ip = N_i(x_p)
  domains  // its part of the body: N_ip is the mean over that part
};
/// The change of volume that the law of a material point in two or three dimensions takes.
enum class Dilatation {
  points,  // its own
  cells,   // the mean of its cell's points: F-bar, or B-bar at small strain
  splines  // a projection onto splines of one degree less than the basis; for the linear basis, means over cells
};
/// A face of a box, named for a picture with x to the right, y upwards and z towards the viewer: along each axis the
/// lower face and then the upper one.
enum class Face { left, right, bottom, top, back, front };
constexpr int axis_of(Face face) { return static_cast<int>(face) / 2; }
constexpr bool is_upper(Face face) { return static_cast<int>(face) % 2 == 1; }

/// A part of the surface of a body in space that is not a box.
enum class BodySurface {
  inner,  // the inner surface of a hollow sphere or cylinder
  outer,  // the outer surface of any body: of a cylinder and of a prism the lateral surface
  start,  // the end of a cylinder or of a prism at the start of its axis
  end     // and the other end
};

/// The place where kinetic damping takes the peak of the kinetic energy, which it knows at half steps only.
enum class Peak {
  half_step,  // at the last half step before the fall
  parabolic   // at the top of the parabola through the last three half steps
};

/// The Rayleigh quotient of the motion that adaptive damping takes for ω₁².
enum class Quotient {
  diagonal,  // uᵀSu/uᵀMu,  S_ii = ΔR_i/(h v_i)          [Underwood 1983]
  global     // vᵀΔR/(h vᵀMv)
};

/// How leapfrog and symplectic Euler treat C v in a step from v⁻ to v⁺.
enum class DampingTreatment {
  automatic,  // averaged for leapfrog, implicit for symplectic-euler
  averaged,   // C (v⁻ + v⁺)/2      (leapfrog)
  lagged,     // C v⁻
  implicit,   // C v⁺               (symplectic-euler)
  exact       // v' = M⁻¹Q − c v solved exactly for a frozen Q (symplectic-euler; C and M diagonal together)
};

}  // namespace stillpoint
