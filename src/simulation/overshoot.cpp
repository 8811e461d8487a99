#include "simulation/overshoot.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"

namespace stillpoint {
namespace {

constexpr const char* plastic = "plastic_strain";

// Of the time between two samples, with a power that changes linearly.
double share_below_zero(double before, double after) {
  if (before >= 0 && after >= 0) return 0;
  if (before <= 0 && after <= 0) return 1;
  return std::min(before, after) / (std::min(before, after) - std::max(before, after));
}

}  // namespace

Overshoot::Overshoot(const Scene& scene, const Model& model) : model_(model) {
  const std::vector<std::string>& remembered = model.phase->info().history_names;
  const bool yields = std::ranges::find(remembered, plastic) != remembered.end();
  watches_ = yields && scene.stop.wants_equilibrium() && !model.static_method;
  if (!watches_) return;
  volumes_ = model.phase->point_data().volumes;
  of_points_.resize(volumes_.size());
  constexpr double samples_a_period = 32, periods_of_the_shortest = 100;  // if the longest is not known
  const double period =
      2 * std::numbers::pi * (model.omega_1 ? 1 / *model.omega_1 : periods_of_the_shortest / model.omega_max);
  interval_ = period / samples_a_period;
}

void Overshoot::sample(double t, double power) {
  const double now = plastic_strain();
  if (!std::exchange(begun_, true)) {
    first_ = now;
  } else {
    against_ += share_below_zero(power_, power) * (now - last_);
  }
  last_ = now;
  power_ = power;
  next_ = t + interval_;
}

std::optional<double> Overshoot::share() const {
  return last_ > first_ ? std::optional(against_ / (last_ - first_)) : std::nullopt;
}

std::string Overshoot::note() const {
  constexpr double small = 0.005;  // at which columns of ground in scripts/map_random.py settle 1 % too much
  if (!(share().value_or(0) > small)) return "";
  return fmt::format(
      "{:.0f} % of the plastic strain came about while inertia carried the body on against its forces: under a load "
      "that "
      "grows slowly it yields less; expected a ramp of the load, such as a factor min(t/T, 1), or more damping",
      100 * *share());
}

double Overshoot::plastic_strain() {
  model_.phase->point_history(plastic, of_points_);
  return sum_over(volumes_.size(), [&](std::size_t p) { return volumes_[p] * of_points_[p]; });
}

}  // namespace stillpoint
