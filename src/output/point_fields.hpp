// Fields at the material points, by the names that scenes and outputs use.
#pragma once

#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// "u", "v", "strain", "stress", "volume" and what the laws remember ("plastic_strain"), as (P × components). Throws
/// std::invalid_argument for another name.
std::vector<double> point_field(const LagrangianPhase& phase, const std::string& name, double t, ConstVec u,
                                ConstVec v);

/// Whether there is such a field.
bool is_field(const LagrangianPhase& phase, const std::string& name);

/// Where the points are at (t, u), (P × dim) [m].
std::vector<double> current_positions(const LagrangianPhase& phase, double t, ConstVec u);

/// What a motion x, (n), changes of a quantity at the points by itself, without what supports do: (P × components).
std::vector<double> change_of(const LagrangianPhase& phase, PointQuantity quantity, double t, ConstVec x);

/// A field as a probe names it, "u" in one dimension, "stress.xy" in the plane.
struct PointFieldComponent {
  std::string name;
  std::size_t component, components;
};
PointFieldComponent find_point_field(const LagrangianPhase& phase, const std::string& field);

}  // namespace stillpoint
