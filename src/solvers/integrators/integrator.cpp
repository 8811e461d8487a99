#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/gpl.hpp"
#include "base/text.hpp"
#include "solvers/integrators/integrator_families.hpp"

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

// Leapfrog and symplectic Euler depend on how they treat damping; the others do not.
using MethodOf = Method (*)(DampingTreatment);
constexpr MethodOf staggered[] = {leapfrog_method, symplectic_euler_method};

std::vector<Method> only_leapfrog() { return {leapfrog_method(DampingTreatment::automatic)}; }
std::vector<Method> only_symplectic_euler() { return {symplectic_euler_method(DampingTreatment::automatic)}; }

/// Methods whose names begin alike, and the function that makes an integrator of any of them.
struct Family {
  std::string_view begin;
  std::vector<Method> (*methods)();
  std::unique_ptr<Stepper> (*make)(const IntegratorOptions&, RelaxationSystem&);
};

constexpr Family families[] = {{"leapfrog", only_leapfrog, make_leapfrog},
                               {"symplectic-euler", only_symplectic_euler, make_symplectic_euler},
                               {"erk:", erk_methods, make_erk},
                               {"gsl:", gsl_methods, make_gsl}};

}  // namespace

std::vector<Method> methods() {
  std::vector<Method> all;
  for (const Family& family : families) std::ranges::move(family.methods(), std::back_inserter(all));
  return all;
}

Method find_method(std::string_view name, DampingTreatment treatment) {
  for (const MethodOf method_of : staggered) {
    if (method_of(DampingTreatment::automatic).name == name) return method_of(treatment);
  }
  std::vector<std::string> names;
  for (Method& method : methods()) {
    if (method.name == name) {
      require(treatment == DampingTreatment::automatic,
              fmt::format("method '{}' has no choice of damping treatment", name));
      return std::move(method);
    }
    names.push_back(method.name);
  }
  const std::string why = why_no_integrator(std::string(name));
  throw std::invalid_argument(why.empty() ? unknown_word("there is no integrator", std::string(name), names) : why);
}

double critical_step(const Method& method, const Damping& damping, const DampedSpectrum& spectrum) {
  if (!damping.is_local() || !method.oscillator_step || !(spectrum.omega_max > 0))
    return critical_step(method.amplification, spectrum);
  DampedSpectrum undamped = spectrum;
  undamped.stiffness_factor = 1;
  return std::min(critical_step(method.amplification, undamped),
                  switched_stability_limit(method.oscillator_step, damping) / spectrum.omega_max);
}

std::unique_ptr<Stepper> make_integrator(const IntegratorOptions& options, RelaxationSystem& system) {
  const Method method = find_method(options.method, options.treatment);
  validate(options, method);
  require(method.remembers_force || !system.damping().uses_last_force(),
          fmt::format("a damping by the change of the force does not go with method '{}', but with leapfrog and "
                      "symplectic-euler",
                      method.name));
  const auto family = std::ranges::find_if(
      families, [&](std::string_view begin) { return method.name.starts_with(begin); }, &Family::begin);
  return family->make(options, system);
}

}  // namespace stillpoint
