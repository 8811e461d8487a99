#include "prescribed_motion.hpp"

#include <algorithm>
#include <cmath>

#include <gsl/gsl_deriv.h>

namespace stillpoint {

double PrescribedMotion::velocity(double t) const {
  if (!moves_) return 0;
  gsl_function formula{
      [](double at, void* self) { return static_cast<const PrescribedMotion*>(self)->displacement(at); },
      const_cast<PrescribedMotion*>(this)};
  double slope = 0, error = 0;
  gsl_deriv_central(&formula, t, 1e-3 * std::max(1.0, std::abs(t)), &slope, &error);
  return slope;
}

// u'' = (−u(t − 2h) + 16 u(t − h) − 30 u(t) + 16 u(t + h) − u(t + 2h))/(12 h²) + O(h⁴)
double PrescribedMotion::acceleration(double t) const {
  if (!moves_) return 0;
  const double h = 2e-3 * std::max(1.0, std::abs(t));
  const auto u = [this](double at) { return displacement(at); };
  return (16 * (u(t - h) + u(t + h)) - (u(t - 2 * h) + u(t + 2 * h)) - 30 * u(t)) / (12 * h * h);
}

}  // namespace stillpoint
