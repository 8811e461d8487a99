// A damping, a relaxation or a static solver by its name alone, for tests that try them all.
#pragma once

#include <stillpoint/relaxation.hpp>

#include <memory>
#include <string>

#include "plan/catalogue.hpp"
#include "solvers/statics/static_methods.hpp"

namespace stillpoint::test {

/// The damping of that name; none for a relaxation or a static solver.
inline std::unique_ptr<Damping> damping_of(const std::string& name, double c, double alpha) {
  const StrategyInfo* strategy = catalogue().strategy(name);
  return strategy && !strategy->is_relaxation ? make_damping(name, c, alpha) : no_damping();
}

/// The override by which a scene takes it.
inline std::string override_of(const std::string& name) {
  return (catalogue().static_method(name) ? "solve.method=" : "damping.strategy=") + name;
}

/// What steps the system on that way to rest, with options.max_step.
inline std::unique_ptr<Stepper> stepper_of(const std::string& name, IntegratorOptions options, RelaxationSystem& system,
                                           RelaxationOptions relaxing = {}) {
  if (catalogue().static_method(name)) {
    return make_static_method({.name = name, .max_step = options.max_step, .tolerance = 1e-12}, system);
  }
  const RelaxationInfo* relaxation = find_relaxation(name);
  if (!relaxation) return make_integrator(options, system);
  options.halts_at_energy_peaks = relaxation->is_event_of_erk;
  if (!find_method(options.method).hosts_relaxations) return make_integrator(options, system);
  relaxing.name = name;
  relaxing.max_step = options.max_step;
  return make_relaxation(relaxing, system);
}

}  // namespace stillpoint::test
