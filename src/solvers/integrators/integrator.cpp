#include <stillpoint/integrator.hpp>

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "solvers/integrators/arkode_erk.hpp"
#include "solvers/integrators/gsl_integrator.hpp"
#include "solvers/integrators/staggered_integrators.hpp"
#include "solvers/relaxation/relaxations.hpp"

namespace stillpoint {
namespace {

void require(bool ok, const std::string& message) {
  if (!ok) throw std::invalid_argument(message);
}

void validate(const IntegratorOptions& options, const Method& method) {
  require(options.max_step > 0 && std::isfinite(options.max_step),
          fmt::format("the integrator's max_step must be > 0, found {}", options.max_step));
  if (options.rtol) {
    require(method.adaptive, fmt::format("method '{}' has no error estimate, so rtol cannot be set", method.name));
    require(*options.rtol > 0 && *options.rtol < 1, fmt::format("rtol must be in (0, 1), found {}", *options.rtol));
    require(options.atol_u > 0 && options.atol_v > 0, "atol_u and atol_v must be > 0");
  } else {
    require(method.fixed_step, fmt::format("method '{}' is adaptive only: set rtol", method.name));
  }
}

}  // namespace

std::vector<Method> methods() {
  std::vector<Method> all = {leapfrog_method(DampingTreatment::automatic),
                             symplectic_euler_method(DampingTreatment::automatic)};
  for (auto&& family : {erk_methods(), gsl_methods()}) all.insert(all.end(), family.begin(), family.end());
  return all;
}

Method find_method(std::string_view name, DampingTreatment treatment) {
  if (name == "leapfrog") return leapfrog_method(treatment);
  if (name == "symplectic-euler") return symplectic_euler_method(treatment);
  std::vector<std::string> names;
  for (Method& method : methods()) {
    if (method.name == name) {
      require(treatment == DampingTreatment::automatic,
              fmt::format("method '{}' has no choice of damping treatment", name));
      return std::move(method);
    }
    names.push_back(method.name);
  }
  const std::string near = nearest(std::string(name), names);
  throw std::invalid_argument(fmt::format("there is no integrator '{}'{}", name,
                                          near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, RelaxationSystem& system) {
  const Method method = find_method(options.method, options.treatment);
  validate(options, method);
  const DampingInfo* strategy = known_damping(system.damping().name());
  if (strategy) {
    require(strategy->goes_with(method.name),
            fmt::format("damping '{}' does not go with method '{}', but with {}", strategy->name, method.name,
                        fmt::join(strategy->integrators, ", ")));
    if (strategy->owns_iteration && method.name == "leapfrog") {
      require(options.treatment == DampingTreatment::automatic,
              fmt::format("damping '{}' owns its iteration, which has no choice of damping treatment", strategy->name));
      return make_strategy(options, system);
    }
  }
  if (method.name == "leapfrog") return make_leapfrog(options, system);
  if (method.name == "symplectic-euler") return make_symplectic_euler(options, system);
  return method.name.starts_with("erk:") ? make_erk(options, system) : make_gsl(options, system);
}

}  // namespace stillpoint
