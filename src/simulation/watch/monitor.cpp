#include "simulation/watch/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace stillpoint {

RunStatus Monitor::observe(double t, double residual, double kinetic_energy, double work_scale, bool settled,
                           std::optional<double> distance, bool moves) {
  next_check_ = t + options_.dwell / checks_a_dwell;
  peak_kinetic_energy_ = std::max(peak_kinetic_energy_, kinetic_energy);
  if (!std::isfinite(residual) || !std::isfinite(kinetic_energy)) {
    reason_ =
        fmt::format("residual {:.3g} and kinetic energy {:.3g} at t = {:.6g}: not finite", residual, kinetic_energy, t);
    return RunStatus::diverged;
  }
  if (options_.residual <= 0 && options_.distance <= 0) return RunStatus::running;

  const bool near = options_.distance <= 0 || (distance ? *distance <= options_.distance : !options_.distance_is_asked);
  const bool creeps = way_left_ && !(*way_left_ <= allowed_way_);
  const bool balanced = settled && near && !creeps && (options_.residual <= 0 || residual <= options_.residual);
  constexpr double rounding = 1e-20;  // relative error of an energy, from velocities to ten digits
  const bool small = kinetic_energy <= options_.kinetic_energy * peak_kinetic_energy_;
  const bool at_rest = options_.kinetic_energy <= 0 || small || kinetic_energy <= rounding * work_scale;
  waits_for_.clear();
  if (!balanced || !at_rest) {
    balanced_since_ = -1;
    waits_for_ = missing(settled, near, distance, creeps);
    if (waits_for_.empty() && !at_rest)
      waits_for_ = fmt::format("kinetic energy {:.2g} > {:.2g} of its peak", kinetic_energy / peak_kinetic_energy_,
                               options_.kinetic_energy);
    return RunStatus::running;
  }
  if (balanced_since_ < 0) balanced_since_ = t;
  const bool must_last = options_.must_last && moves;
  if (must_last && t - balanced_since_ < options_.dwell * (1 - 1e-12)) {
    waits_for_ = fmt::format("in balance for {:.3g} of {:.3g} s", t - balanced_since_, options_.dwell);
    return RunStatus::running;
  }
  std::vector<std::string> tests;
  if (options_.residual > 0) tests.push_back(fmt::format("residual {:.3g} <= {:.3g}", residual, options_.residual));
  if (options_.distance > 0 && distance)
    tests.push_back(fmt::format("distance {:.3g} <= {:.3g}", *distance, options_.distance));
  if (way_left_)
    tests.push_back(fmt::format("way left {:.3g} <= {:.3g} of the displacement", *way_left_, allowed_way_));
  if (options_.kinetic_energy > 0 && moves) {
    if (!small) {
      tests.push_back(fmt::format("kinetic energy {:.3g} of the work, which is rounding", kinetic_energy / work_scale));
    } else if (peak_kinetic_energy_ > 0) {
      tests.push_back(fmt::format("kinetic energy {:.3g} <= {:.3g} of its peak", kinetic_energy / peak_kinetic_energy_,
                                  options_.kinetic_energy));
    } else {
      tests.emplace_back("nothing has moved");
    }
  }
  reason_ = fmt::format("{}", fmt::join(tests, " and "));
  if (must_last) reason_ += fmt::format(", held for {:.4g} s", t - balanced_since_);
  return RunStatus::equilibrium;
}

std::string Monitor::missing(bool settled, bool near, std::optional<double> distance, bool creeps) const {
  if (!settled) return "the end of the loads";
  if (!near) return distance ? fmt::format("distance {:.2g} > {:.2g}", *distance, options_.distance) : "a distance";
  if (!creeps) return "";
  return std::isfinite(*way_left_)
             ? fmt::format("way left {:.2g} > {:.2g} of the displacement", *way_left_, allowed_way_)
             : "a motion that dies out";
}

RunStatus Monitor::check_limits(double t, long steps) {
  if (options_.end_time > 0 && t >= options_.end_time) {
    reason_ = fmt::format("t = {:.6g} reached stop.time", t);
    return RunStatus::end_time;
  }
  if (options_.steps > 0 && steps >= options_.steps) {
    reason_ = fmt::format("{} steps reached stop.steps", steps);
    return RunStatus::step_limit;
  }
  return RunStatus::running;
}

}  // namespace stillpoint
