// The largest stable step of a one-step method, from its amplification and the spectrum.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/mass.hpp>

#include <functional>
#include <vector>

namespace stillpoint {

/// |largest eigenvalue| of one step's map for u'' + rate·u' + omega² u = 0 with step h: stable if ≤ 1.
using AmplificationRadius = std::function<double(double h, double omega, double rate)>;

/// The ranges that the stability of u'' + rate·u' + omega² u = 0 depends on, over all modes of M a + C v + K u = 0. By
/// Rayleigh quotients every eigenvalue of the damped system solves λ² + rate λ + omega² = 0 with some omega and rate in
/// these ranges.
struct DampedSpectrum {
  double omega_1 = 0;    // lowest angular frequency [rad/s]; 0 if unknown
  double omega_max = 0;  // highest angular frequency [rad/s]
  double rate_min = 0;   // smallest and largest vᵀCv / vᵀMv [1/s]
  double rate_max = 0;
  double stiffness_factor = 1;  // Damping::stiffness_factor() of local damping
};

/// The spectrum with the rates of C = mass·M + identity·I: [c_m + c_i/max m, c_m + c_i/min m] with the extreme
/// eigenvalues m of M.
DampedSpectrum damped_spectrum(double omega_1, double omega_max, const Damping& damping, const Mass& mass);

/// The largest h such that the amplification stays ≤ 1 for every step in (0, h] and every mode [s]. 0 if no step is
/// stable.
double critical_step(const AmplificationRadius& amplification, const DampedSpectrum& spectrum);

/// Oscillators u' = v, v' = Q + D(v, Q), Q = −u, with a local damping D, each by itself.
struct Oscillators {
  std::vector<double> u, v;  // (oscillators)
};
/// One step h of all oscillators, updated in place.
using OscillatorStep = std::function<void(double h, const Damping& local, Oscillators& all)>;

/// The largest h up to which no motion of that oscillator grows, wherever it begins. D switches with the signs of v and
/// Q, from stage to stage of a step too: each piece is linear, and a step that is stable for every piece may still let
/// motions grow that meet the switches in time with it. 0 if there is no such h.
double switched_stability_limit(const OscillatorStep& step, const Damping& local);

/// The largest r = h·omega for one oscillator of damping ratio zeta = rate/(2 omega): the method's own stability limit.
double stability_limit(const AmplificationRadius& amplification, double zeta);

}  // namespace stillpoint
