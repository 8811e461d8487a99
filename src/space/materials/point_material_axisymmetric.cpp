#include "space/materials/law_by_name.hpp"

namespace stillpoint {

template <>
Made<Kinematics::axisymmetric> make_point_material(const MaterialSpec& material, StressState, std::size_t begin,
                                                   std::size_t count, bool updated_lagrangian) {
  return make_material_of<StressState::axisymmetric>(material, begin, count, updated_lagrangian);
}

}  // namespace stillpoint
