#include "solvers/integrators/trial_stepper.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "linalg/vector_operations.hpp"
#include "system/largest_at.hpp"

namespace stillpoint {

TrialStepper::TrialStepper(const IntegratorOptions& options, RelaxationSystem& system)
    : Stepper(system), options_(options), division_(options.max_step) {}

void TrialStepper::start(double t, Vector& y) {
  if (y.size() != 2 * system().size()) {
    throw std::invalid_argument(fmt::format("y has {} entries, 2n is {}", y.size(), 2 * system().size()));
  }
  if (!trial_) trial_ = system().vectors().like(y);
  if (!same_kind(*trial_, y)) throw std::invalid_argument("y is another kind of N_Vector than at the first start");
  t_ = t;
  y_ = &y;
  u_.emplace(system().vectors().view(first_half(y.span())));
  trial_u_.emplace(system().vectors().view(first_half(trial_->span())));
  system().forget_force();
  begun(begin(t, y));
  system().remember_force();
}

StepReport TrialStepper::step(double t_stop) {
  if (!y_) throw std::logic_error("step() before start()");
  if (!(t_stop > t_) || !std::isfinite(t_stop)) {
    throw std::invalid_argument(fmt::format("there is no step from t = {} to {}", t_, t_stop));
  }
  if (!is_admissible_) {
    constexpr auto status = StepReport::Status::inadmissible;
    return {.status = status, .t = t_, .message = message_of({.status = status}, 0)};
  }
  is_at_state_ = false;
  double h = adaptive() ? options_.max_step : division_.step_from(t_, t_stop);
  bool keeps_clear = true;  // of states that cannot be evaluated
  for (int halvings = 0;; ++halvings) {
    Attempt tried = attempt(t_, *y_, h, t_stop, *trial_);
    if (tried.status == StepReport::Status::ok) {
      const bool finite = is_finite(tried);
      if (finite && keeps_clear) return take(tried);
      refused();
      if (finite) {
        keeps_clear = true;
        h = tried.h / clearance;
        continue;
      }
      tried = {.status = StepReport::Status::not_finite, .h = tried.h};
    }
    const bool retry = tried.status == StepReport::Status::inadmissible && tried.h > 0 && halvings < max_halvings;
    if (!retry) return {.status = tried.status, .t = t_, .h = tried.h, .message = message_of(tried, halvings)};
    ++rejected_;
    keeps_clear = keeps_clear && system().last().trial->too_far;
    h = tried.h / 2;
  }
}

void TrialStepper::set_max_step(double h) {
  if (h == options_.max_step) return;
  options_.max_step = h;
  division_ = StepDivision(h);
  max_step_changed();
}

void TrialStepper::archive(const StateArchive& state) {
  double max_step = options_.max_step;
  state("max_step", max_step);
  if (state.restores()) set_max_step(max_step);
  division_.archive(state);
  state("steps", steps_);
  state("rejected", rejected_);
  archive_memory(state);
}

std::string TrialStepper::message_of(const Attempt& tried, int halvings) const {
  const auto refusal = [this] { return system().system().diagnosis().refusal(*system().last().trial); };
  switch (tried.status) {
    case StepReport::Status::inadmissible:
      if (tried.h == 0) return "the state cannot be evaluated: " + refusal();
      return fmt::format("the trial state cannot be evaluated, also after {} halvings of the step: {}", halvings,
                         refusal());
    case StepReport::Status::not_finite:
      return fmt::format("{}; {}; expected a smaller step, or more damping",
                         tried.message.empty() ? "the new state is not finite" : tried.message,
                         divergence_at(system().system(), std::as_const(*y_).span(), std::as_const(*trial_).span()));
    default:
      return tried.message;
  }
}

// A sum of squares is finite only if every entry is.
bool TrialStepper::is_finite(const Attempt& attempt) const {
  if (attempt.is_finite) return *attempt.is_finite;
  return std::isfinite(attempt.keeps_v ? dot(*trial_u_, *trial_u_) : dot(*trial_, *trial_));
}

StepReport TrialStepper::take(const Attempt& attempt) {
  const ConstVec trial = std::as_const(*trial_).span();
  const Vec u = first_half(y_->span()), v = second_half(y_->span());
  const double *u_new = first_half(trial).data(), *v_new = second_half(trial).data();
  if (attempt.keeps_v) {
    for_each_index(u.size(), [=](std::size_t i) { u[i] = u_new[i]; });
  } else {
    for_each_index(u.size(), [=](std::size_t i) {
      u[i] = u_new[i];
      v[i] = v_new[i];
    });
  }
  is_at_state_ = true;
  accepted();
  system().remember_force();
  t_ = adaptive() ? attempt.t : division_.arrive(t_, attempt.h);
  ++steps_;
  return {.status = StepReport::Status::ok, .t = t_, .h = attempt.h};
}

}  // namespace stillpoint
