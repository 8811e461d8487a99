#include "space/phase/phase_of_basis.hpp"

namespace stillpoint {

// Hermite's basis, with eight functions at a node and three unknowns each, is not available in space.
template <>
std::unique_ptr<LagrangianPhase> make_phase_of<Kinematics::space>(const Problem& problem, const PhaseBegin& begin) {
  return make_phase_of_splines<BSpline, Kinematics::space>(problem, begin);
}

}  // namespace stillpoint
