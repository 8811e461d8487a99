// The frequencies of a scene by every method that it allows, and the quantities that follow from them.
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
  int evaluations = 0;       // of the internal force in a step
};

struct SpectrumStudy {
  struct Estimate {
    std::string what, how;  // "omega_1" or "omega_max", and the method
    FrequencyEstimate found;
  };
  std::vector<Estimate> estimates;
  FrequencyEstimate omega_1, omega_max;             // the estimates from which all else follows
  std::optional<double> balanced_c, balanced_step;  // for leapfrog with a multigrid mass [1/s], [s]
  std::string strategy;                             // damping.strategy
  bool knows_steps = true;                          // false if c = "critical" and there is no omega_1
  std::vector<MethodStep> steps{};                  // one for every integrator that has a critical step

  double kappa() const { return omega_max.omega / omega_1.omega * (omega_max.omega / omega_1.omega); }
  double critical_damping() const { return 2 * omega_1.omega; }  // [1/s]
};

/// The spectrum of the elastic tangent at the start. Throws SceneError if the scene cannot be set up.
SpectrumStudy spectrum_of(const Problem& problem);

}  // namespace stillpoint
