// The kinematics and the basis of a scene become template parameters here, once.
#include "space/phase/phase_factory.hpp"

#include <stdexcept>

namespace stillpoint {

std::unique_ptr<LagrangianPhase> make_phase(const Scene& scene) {
  const bool domains = scene.phase.quadrature == Quadrature::domains;
  switch (kinematics(scene.state)) {
    case Kinematics::line:
      return domains ? make_phase_of_domains<Kinematics::line>(scene) : make_phase_of<Kinematics::line>(scene);
    case Kinematics::plane:
      return domains ? make_phase_of_domains<Kinematics::plane>(scene) : make_phase_of<Kinematics::plane>(scene);
    case Kinematics::axisymmetric:
      return make_phase_of<Kinematics::axisymmetric>(scene);
    case Kinematics::space:
      if (!domains) return make_phase_of<Kinematics::space>(scene);
      break;
  }
  throw std::logic_error("a kinematics without an instantiation");
}

}  // namespace stillpoint
