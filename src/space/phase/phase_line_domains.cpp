#include "space/phase/phase_of_basis.hpp"

namespace stillpoint {

template std::unique_ptr<LagrangianPhase> make_phase_of_domains<Kinematics::line>(const Problem& problem,
                                                                                  const PhaseBegin& begin);

}  // namespace stillpoint
