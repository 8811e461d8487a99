// The frequencies of a scene by every method that it allows, and what follows from them.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/spectrum.hpp>

#include <optional>
#include <string>
#include <vector>

namespace stillpoint {

struct MethodStep {
  std::string method;
  double critical_step = 0;  // [s]
  int evaluations = 0;       // of the internal force, a step
};

struct SpectrumStudy {
  struct Estimate {
    std::string what, how;  // "omega_1" or "omega_max", and by which method
    FrequencyEstimate found;
  };
  std::vector<Estimate> estimates;
  FrequencyEstimate omega_1, omega_max;             // those that all else is from
  std::optional<double> balanced_c, balanced_step;  // of leapfrog with a multigrid mass [1/s], [s]
  std::string strategy;                             // damping.strategy
  bool knows_steps = true;                          // false: c = "critical", and there is no omega_1
  std::vector<MethodStep> steps{};                  // of every integrator that has one

  double kappa() const { return omega_max.omega / omega_1.omega * (omega_max.omega / omega_1.omega); }
  double critical_damping() const { return 2 * omega_1.omega; }  // [1/s]
};

/// Of the elastic tangent at the start. Throws SceneError if the scene cannot be set up.
SpectrumStudy spectrum_of(const Problem& problem);

}  // namespace stillpoint
