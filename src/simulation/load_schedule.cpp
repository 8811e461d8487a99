#include "simulation/load_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace stillpoint {

std::vector<double> loads_at(const SemiDiscrete& system, double t) {
  const std::vector<double> rest(system.size(), 0.0);
  std::vector<double> F(system.size());
  system.external_force(t, rest, F);
  return F;
}

std::vector<double> total_load_at(const SemiDiscrete& system, double t) {
  const std::vector<double> rest(system.size(), 0.0);
  std::vector<double> Q = loads_at(system, t), R(system.size());
  system.internal_force(t, rest, R, *system.make_trial());
  for (std::size_t i = 0; i < Q.size(); ++i) Q[i] -= R[i];
  return Q;
}

LoadSchedule::LoadSchedule(const Scene& scene, const SemiDiscrete& system, double end_time)
    : scene_(scene), system_(system), end_time_(end_time) {
  supports_move_ = std::ranges::any_of(scene.supports, [](const auto& s) { return s.motion.uses('t'); });
  if (end_time > 0 && loads_vary(scene)) at_end_ = load(end_time);
}

// The loads alone if no support moves: R(u = 0) changes with what a body remembers.
std::vector<double> LoadSchedule::load(double t) const {
  return supports_move_ ? total_load_at(system_, t) : loads_at(system_, t);
}

bool LoadSchedule::settled(double t) const {
  if (at_end_.empty()) return true;
  constexpr double rounding = 1e-9;
  for (const WallSpec& wall : scene_.walls) {
    const double end = wall.motion({}, end_time_), left = std::abs(end - wall.motion({}, t));
    if (left > rounding * std::abs(end - wall.motion({}, 0))) return false;
  }
  const bool remembers = supports_move_ && system_.history_dependent();
  const std::vector<double> now = load(t), end = remembers ? load(end_time_) : at_end_;
  double difference = 0, scale = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    difference = std::max(difference, std::abs(now[i] - end[i]));
    scale = std::max({scale, std::abs(now[i]), std::abs(end[i])});
  }
  return difference <= rounding * scale;
}

}  // namespace stillpoint
