#include "study/rest_or_motion.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>
#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/spectrum.hpp>
#include <stillpoint/state_norms.hpp>
#include <stillpoint/stepper.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace stillpoint {
namespace {

/// What is seen of a period.
struct Period {
  double residual;  // mean
  double way;       // ‖u − u₀‖ at its end
};

double distance(ConstVec a, ConstVec b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// How far the body has to go on until the residual is 0, if that falls with the way as over the last half of the
// periods, as a multiple of the way that it has made.
double remaining_way(const std::vector<Period>& periods) {
  const Period &last = periods.back(), &middle = periods[periods.size() / 2];
  const double fall = (middle.residual - last.residual) / (last.way - middle.way);
  return fall > 0 ? last.residual / fall / last.way : std::numeric_limits<double>::infinity();
}

bool goes_on(const std::vector<Period>& periods) {
  constexpr std::size_t least = 5;
  constexpr double far = 0.5;  // slopes that came to rest had 0.2 to 0.31 left, even 0.4 % below the factor that moves
  return periods.size() >= least && periods.back().way > periods[periods.size() - 2].way &&
         remaining_way(periods) > far;
}

class CriticallyDampedMotion {
 public:
  CriticallyDampedMotion(LagrangianPhase& phase, double t, ConstVec u, double omega_1, const MotionLimits& limits)
      : phase_(phase),
        limits_(limits),
        start_(u.begin(), u.end()),
        period_(2 * std::numbers::pi / omega_1),
        steps_(std::ceil(period_ * omega_max_by_lanczos(phase, t, u).omega / (2 * share_of_critical))),
        damping_(make_damping("viscous", 2 * omega_1, 0)),
        system_(phase, *damping_, vectors_),
        norms_(system_),
        y_(vectors_.make(2 * start_.size())),
        stepper_(make_integrator({.max_step = period_ / steps_}, system_)),
        t_(t),
        far_away_(t + 1e9 * period_) {
    std::ranges::copy(start_, first_half(y_.span()).begin());
    std::ranges::fill(second_half(y_.span()), 0.0);
    stepper_->start(t, y_);
    stepper_->accept(t);
  }

  RestOrMotion follow() {
    using enum RestOrMotion::End;
    constexpr std::size_t few = 5, between_statics = 30;
    std::size_t times_going_on = 0;
    while (static_cast<int>(periods_.size()) < limits_.periods) {
      double sum = 0, largest = 0;
      for (int k = 0; k < static_cast<int>(steps_); ++k) {
        if (limits_.interrupted && limits_.interrupted()) return ended(interrupted, "interrupted by the user");
        const StepReport report = stepper_->step(far_away_);
        if (report.status != StepReport::Status::ok)
          return ended(undecided, fmt::format("a critically damped motion could not be followed beyond {} periods: {}",
                                              periods_.size(), report.message));
        t_ = report.t;
        stepper_->accept(t_);
        const double residual = norms_.last_residual();
        sum += residual;
        largest = std::max(largest, residual);
      }
      if (phase_.info().may_touch) {
        system_.change_last([this](Vec R, TrialState& trial) {
          phase_.control().update_multipliers(t_, u(), /*evenly=*/true, R, trial);
        });
        stepper_->take_changed_forces(t_);
      }
      periods_.push_back({sum / steps_, distance(u(), start_)});
      if (largest <= limits_.residual)
        return ended(rests, fmt::format("residual {:.3g} <= {:.3g} for a period of 2 pi/omega_1, after {} periods of a "
                                        "critically damped motion",
                                        largest, limits_.residual, periods_.size()));
      times_going_on = goes_on(periods_) ? times_going_on + 1 : 0;
      if (times_going_on == few)
        return ended(moves, fmt::format("after {} periods of 2 pi/omega_1 of a critically damped motion the mean "
                                        "residual is {:.3g}, and falls so slowly that the way to rest would be at "
                                        "least half as long again as the way so far",
                                        periods_.size(), periods_.back().residual));
      if (limits_.settles && periods_.size() % between_statics == 0 && limits_.settles(t_, first_half(y_.span())))
        return ended(rests, fmt::format("Newton's method found the equilibrium after {} periods of a critically damped "
                                        "motion",
                                        periods_.size()));
    }
    return ended(undecided, fmt::format("the mean residual is {:.3g} after {} periods of a critically damped motion",
                                        periods_.back().residual, periods_.size()));
  }

 private:
  static constexpr double share_of_critical = 0.8;  // as contact needs it

  ConstVec u() const { return first_half(std::as_const(y_).span()); }
  RestOrMotion ended(RestOrMotion::End end, std::string reason) const {
    return {end, std::move(reason), {u().begin(), u().end()}, system_.evaluations()};
  }

  LagrangianPhase& phase_;
  const MotionLimits& limits_;
  const std::vector<double> start_;
  const double period_, steps_;  // [s], in a period
  const VectorSpace vectors_;
  const std::unique_ptr<Damping> damping_;
  RelaxationSystem system_;
  StateNorms norms_;
  Vector y_;
  const std::unique_ptr<Stepper> stepper_;
  double t_;
  const double far_away_;  // a step towards it has the length that it would have by itself
  std::vector<Period> periods_;
};

}  // namespace

RestOrMotion rest_or_motion(LagrangianPhase& phase, double t, ConstVec u, const MotionLimits& limits) {
  const FrequencyEstimate omega_1 = omega_1_by_lanczos(phase, t, u);
  if (!omega_1.converged)
    return {
        RestOrMotion::End::undecided, "the lowest frequency is not known: " + omega_1.status, {u.begin(), u.end()}, 0};
  return CriticallyDampedMotion(phase, t, u, omega_1.omega, limits).follow();
}

}  // namespace stillpoint
