#include "space/materials/law_by_name.hpp"

namespace stillpoint {

template <>
Made<Kinematics::space> make_point_material(const MaterialSpec& material, StressState, std::size_t begin,
                                            std::size_t count, bool updated_lagrangian) {
  return make_material_of<StressState::space>(material, begin, count, updated_lagrangian);
}

}  // namespace stillpoint
