#include "space/phase/phase_places.hpp"

namespace stillpoint {

template class PhasePlaces<Kinematics::line>;
template class PhasePlaces<Kinematics::plane>;
template class PhasePlaces<Kinematics::axisymmetric>;
template class PhasePlaces<Kinematics::space>;

}  // namespace stillpoint
