#include "space/boundary/prescribed_motion.hpp"

#include <cmath>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

// The value difference(t), or that at t + 2h if the stencil reaches times at which the formula has no value.
template <class Difference>
double where_defined(const Difference& difference, double t, double h) {
  const double value = difference(t);
  return std::isfinite(value) ? value : difference(t + 2 * h);
}

}  // namespace

// u' = (u(t − 2h) − 8 u(t − h) + 8 u(t + h) − u(t + 2h))/(12 h) + O(h⁴)
double PrescribedMotion::velocity(double t) const {
  if (!moves_) return 0;
  const auto difference = [this, h = h_](double at) {
    return (displacement(at - 2 * h) - 8 * displacement(at - h) + 8 * displacement(at + h) - displacement(at + 2 * h)) /
           (12 * h);
  };
  return where_defined(difference, t, h_);
}

// u'' = (−u(t − 2h) + 16 u(t − h) − 30 u(t) + 16 u(t + h) − u(t + 2h))/(12 h²) + O(h⁴)
double PrescribedMotion::acceleration(double t) const {
  if (!moves_) return 0;
  const auto difference = [this, h = h_](double at) {
    return (16 * (displacement(at - h) + displacement(at + h)) - (displacement(at - 2 * h) + displacement(at + 2 * h)) -
            30 * displacement(at)) /
           (12 * h * h);
  };
  return where_defined(difference, t, h_);
}

double PrescribedMotion::velocity_over(double t, double h) const {
  if (!moves_) return 0;
  const auto difference = [this, h](double at) { return (displacement(at + h) - displacement(at - h)) / (2 * h); };
  return where_defined(difference, t, h);
}

double PrescribedMotion::acceleration_over(double t, double h) const {
  if (!moves_) return 0;
  const auto difference = [this, h](double at) {
    return (displacement(at - h) - 2 * displacement(at) + displacement(at + h)) / (h * h);
  };
  return where_defined(difference, t, h);
}

void check_motion(std::size_t support, const PrescribedMotion& motion) {
  const double u = motion.displacement(0);
  if (motion.moves() || std::isfinite(u)) return;
  throw_scene_error(fmt::format("support[{}].u", support),
                    fmt::format("the formula is {} at ({:.6g}); expected a finite number wherever the support holds",
                                std::isnan(u) ? "not a number" : "infinite", fmt::join(motion.position(), ", ")));
}

}  // namespace stillpoint
