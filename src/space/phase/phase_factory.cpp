// Turns the kinematics and the basis of a scene into template parameters.
#include "space/phase/phase_factory.hpp"

#include <stdexcept>

namespace stillpoint {

std::unique_ptr<LagrangianPhase> make_phase(const Problem& problem) {
  const bool domains = problem.phase.quadrature == Quadrature::domains;
  switch (kinematics(problem.state)) {
    case Kinematics::line:
      return domains ? make_phase_of_domains<Kinematics::line>(problem) : make_phase_of<Kinematics::line>(problem);
    case Kinematics::plane:
      return domains ? make_phase_of_domains<Kinematics::plane>(problem) : make_phase_of<Kinematics::plane>(problem);
    case Kinematics::axisymmetric:
      return make_phase_of<Kinematics::axisymmetric>(problem);
    case Kinematics::space:
      if (!domains) return make_phase_of<Kinematics::space>(problem);
      break;
  }
  throw std::logic_error("a kinematics without an instantiation");
}

}  // namespace stillpoint
