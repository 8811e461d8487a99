// Fields at the material points, by the names in scenes and outputs.
#pragma once

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// "u", "v", "strain", "stress", "volume" and the history variables of the laws ("plastic_strain"), as
/// (P × components). Throws std::invalid_argument for another name.
std::vector<double> point_field(const LagrangianPhase& phase, const std::string& name, double t, ConstVec u,
                                ConstVec v);

/// The effective stress σ' = σ + p_w I in the place of a stress in the order of components of a Stress [Pa].
void make_effective(Vec stress, double pore_pressure);

/// The strain ½ (∇u + ∇uᵀ) since the phase began, as a stress has its components: xx; in the plane xx, yy, zz, xy with
/// zz = 0, around an axis zz = u_r/r; in space xx, yy, zz, xy, yz, zx. (P × components)
std::vector<double> strain_tensors(const LagrangianPhase& phase, double t, ConstVec u);

/// The largest component of ∂u/∂x at the points, by its size, since the phase began, and the number of its point.
struct LargestStrain {
  double strain = 0;
  std::size_t point = 0;
};
LargestStrain largest_strain(const LagrangianPhase& phase, double t, ConstVec u);

/// Whether there is a field of this name.
bool is_field(const LagrangianPhase& phase, const std::string& name);

/// The positions of the points at (t, u), (P × dim) [m].
std::vector<double> current_positions(const LagrangianPhase& phase, double t, ConstVec u);

/// The change of a quantity at the points by a motion x, (n), alone, without that by supports: (P × components).
std::vector<double> change_of(const LagrangianPhase& phase, PointQuantity quantity, double t, ConstVec x);

/// The lengths of vectors that follow each other, (P × dim).
std::vector<double> lengths_of(ConstVec vectors, std::size_t dim);

/// A field component as a probe names it, "u" in one dimension, "stress.xy" in the plane.
struct PointFieldComponent {
  std::string name;
  std::size_t component, components;
};
PointFieldComponent find_point_field(const LagrangianPhase& phase, const std::string& field);

}  // namespace stillpoint
