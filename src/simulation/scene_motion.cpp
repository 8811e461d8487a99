#include "simulation/scene_motion.hpp"

#include <stillpoint/relaxation.hpp>

#include <algorithm>

#include "simulation/catalogue.hpp"
#include "simulation/highest_frequency.hpp"

namespace stillpoint {
namespace {

template <class Holds>
bool some_law(const Scene& scene, const Holds& holds) {
  return std::ranges::any_of(scene.bodies, [&](const BodySpec& body) {
    return holds(*catalogue().law(scene.materials.at(body.material).law));
  });
}

}  // namespace

bool remembers(const Scene& scene) {
  return some_law(scene, [](const LawInfo& law) { return law.history_dependent; });
}

bool is_nonlinear(const Scene& scene) {
  return some_law(scene, [](const LawInfo& law) { return law.history_dependent || law.finite_strain; });
}

bool chooses_mass(const Scene& scene) {
  const RelaxationInfo* relaxation = scene.solve.is_static() ? nullptr : find_relaxation(scene.damping.strategy);
  return relaxation && relaxation->chooses_mass;
}

bool steps_tell_omega_1(const Scene& scene, const Motion& motion) {
  const StaticMethodInfo* method = catalogue().static_method(scene.solve.method);
  const bool tells = method ? method->tells_omega_1 : chooses_mass(scene);
  return tells && wants_equilibrium_only(scene) && motion.linear && !motion.moves_on && motion.mass_measures_volume;
}

}  // namespace stillpoint
