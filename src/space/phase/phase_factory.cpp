// Turns the kinematics and the basis of a scene into template parameters.
#include "space/phase/phase_factory.hpp"

#include <memory>
#include <stdexcept>

#include "space/points/carried_body.hpp"

namespace stillpoint {

std::unique_ptr<LagrangianPhase> make_phase(const Problem& problem, const PhaseBegin& begin) {
  const bool domains = problem.phase.quadrature == Quadrature::domains;
  switch (kinematics(problem.state)) {
    case Kinematics::line:
      return domains ? make_phase_of_domains<Kinematics::line>(problem, begin)
                     : make_phase_of<Kinematics::line>(problem, begin);
    case Kinematics::plane:
      return domains ? make_phase_of_domains<Kinematics::plane>(problem, begin)
                     : make_phase_of<Kinematics::plane>(problem, begin);
    case Kinematics::axisymmetric:
      return make_phase_of<Kinematics::axisymmetric>(problem, begin);
    case Kinematics::space:
      if (!domains) return make_phase_of<Kinematics::space>(problem, begin);
      break;
  }
  throw std::logic_error("a kinematics without an instantiation");
}

std::unique_ptr<CarriedBody> make_carried_body(const Problem& problem) {
  switch (kinematics(problem.state)) {
    case Kinematics::line:
      return std::make_unique<CarriedBodyOf<Kinematics::line>>();
    case Kinematics::plane:
      return std::make_unique<CarriedBodyOf<Kinematics::plane>>();
    case Kinematics::axisymmetric:
      return std::make_unique<CarriedBodyOf<Kinematics::axisymmetric>>();
    case Kinematics::space:
      return std::make_unique<CarriedBodyOf<Kinematics::space>>();
  }
  throw std::logic_error("a kinematics without an instantiation");
}

}  // namespace stillpoint
