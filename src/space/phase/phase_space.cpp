#include "space/phase/phase_of_basis.hpp"

namespace stillpoint {

// Hermite's functions, eight to a node and unknowns of three dimensions, are not offered in space.
template <>
std::unique_ptr<LagrangianPhase> make_phase_of<Kinematics::space>(const Problem& problem) {
  return make_phase_of_splines<BSpline, Kinematics::space>(problem);
}

}  // namespace stillpoint
