#include "simulation/scene_motion.hpp"

#include <stillpoint/relaxation.hpp>

#include <algorithm>

#include "simulation/catalogue.hpp"
#include "simulation/highest_frequency.hpp"

namespace stillpoint {
namespace {

template <class Holds>
bool some_law(const Problem& problem, const Holds& holds) {
  return std::ranges::any_of(problem.bodies, [&](const BodySpec& body) {
    return holds(*catalogue().law(problem.materials.at(body.material).law));
  });
}

}  // namespace

bool remembers(const Problem& problem) {
  return some_law(problem, [](const LawInfo& law) { return law.history_dependent; });
}

bool is_nonlinear(const Problem& problem) {
  return some_law(problem, [](const LawInfo& law) { return law.history_dependent || law.finite_strain; });
}

bool chooses_mass(const Problem& problem) {
  const RelaxationInfo* relaxation = problem.solve.is_static() ? nullptr : find_relaxation(problem.damping.strategy);
  return relaxation && relaxation->chooses_mass;
}

bool steps_tell_omega_1(const Problem& problem, const Motion& motion) {
  const StaticMethodInfo* method = catalogue().static_method(problem.solve.method);
  const bool tells = method ? method->tells_omega_1 : chooses_mass(problem);
  return tells && wants_equilibrium_only(problem) && motion.linear && !motion.moves_on && motion.mass_measures_volume;
}

}  // namespace stillpoint
