#include "simulation/standstill.hpp"

#include <fmt/format.h>

#include "simulation/failure.hpp"

namespace stillpoint {

std::string Standstill::description(const LagrangianPhase& phase, PhaseMotion& motion, double t) const {
  return fmt::format(
      "time stands still: each of the last {} steps was shorter than {:.0e} of a step at the start, which is {:.3g} s; "
      "{}; {}; expected smaller loads or cells, or a law that does not stiffen without end",
      patience, next_to_nothing, full_step_, most_stressed(phase, t, motion.u()), furthest_from_rest(motion, t));
}

}  // namespace stillpoint
