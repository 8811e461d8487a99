#include "space/materials/law_by_name.hpp"

namespace stillpoint {

template <>
Made<Kinematics::line> make_point_material(const MaterialSpec& material, StressState state, std::size_t begin,
                                           std::size_t count, bool updated_lagrangian) {
  if (state == StressState::uniaxial_stress)
    return make_material_of<StressState::uniaxial_stress>(material, begin, count, updated_lagrangian);
  return make_material_of<StressState::uniaxial_strain>(material, begin, count, updated_lagrangian);
}

}  // namespace stillpoint
