#include "solvers/statics/static_iteration.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "system/force_scale.hpp"
#include "system/largest_at.hpp"
#include "system/static_balance.hpp"

namespace stillpoint {
namespace {

LoadIncrements increments(const StaticMethodOptions& options) {
  constexpr double smallest = 1e-3;
  const double share = 1.0 / options.load_steps;
  return LoadIncrements({share, share, smallest * share, options.closes_with_friction});
}

}  // namespace

StaticIteration::StaticIteration(const StaticMethodOptions& options, RelaxationSystem& system,
                                 LineSearch::Accuracy sigma)
    : WithoutTime(system, IntegratorOptions{.max_step = options.max_step}),
      sigma_(sigma),
      tolerance_(options.tolerance),
      load_(increments(options)),
      Q_(system.vectors().make(system.size())),
      z_(system.vectors().make(system.size())),
      next_Q_(system.vectors().make(system.size())),
      p_(system.vectors().make(system.size())),
      u_begin_(system.vectors().make(system.size())),
      Q_begin_(system.vectors().make(system.size())) {}

bool StaticIteration::begin(double t, const Vector& y) {
  const ConstVec u = first_half(y.span());
  forget();
  load_.start_over();
  steps_of_first_ = 0;
  supports_set_out_ = is_undisplaced(u);
  if (!supports_set_out_) load_.begin_anew();
  move_supports_on(0);
  if (!system().out_of_balance(t, u, Q_begin_.span())) return false;
  way_.begin(supports_set_out_ ? 0 : 1, system().last().R.span(), system().last().trial->reactions, u);
  std::ranges::fill(Q_.span(), 0.0);
  is_lost_ = false;
  return begin_increment(t, 0, u);
}

TrialStepper::Attempt StaticIteration::attempt(double t, Vector& y, double h, double /*t_stop*/, Vector& trial) {
  const ConstVec u = first_half(std::as_const(y).span());
  const Vec u_new = first_half(trial.span());
  std::ranges::copy(u, u_new.begin());
  std::ranges::fill(second_half(trial.span()), 0.0);
  if (is_lost_) return {.status = StepReport::Status::failed, .h = h, .message = failure()};
  refusal_.clear();
  went_downhill_ = dot(Q_, z_) > 0;
  if (!went_downhill_) return {.h = h};  // in balance to the last bit
  if (makes_no_way() && begin_half(t, u_new)) return {.h = h};
  if (search(t, u_new)) return {.h = h};
  forget();  // the remembered steps may have been useless: next straight downhill
  if (search(t, u_new)) return {.h = h};
  if (!is_as_good_as_balanced() && begin_half(t, u_new)) return {.h = h};
  evaluate(t, u, Q_);  // the last evaluation has to be at the state
  return {.status = StepReport::Status::failed, .h = h, .message = failure()};
}

void StaticIteration::archive_memory(const StateArchive& state) {
  state("Q", Q_.span());
  state("z", z_.span());
  state("p", p_.span());
  state("u_begin", u_begin_.span());
  state("Q_begin", Q_begin_.span());
  state("unbalanced_at_begin", unbalanced_at_begin_);
  state("steps_of_first", steps_of_first_);
  state("steps_of_this", steps_of_this_);
  load_.archive(state);
  state("supports_set_out", supports_set_out_);
  way_.archive(state.part("way"), system().size(), system().last().trial->reactions.size());
  archive_method(state);
  if (state.restores()) move_supports_on(load_.to());
}

// True if that changes the forces. Supports stay where they are if the iteration began with a displaced body.
bool StaticIteration::move_supports_on(double share) {
  return supports_set_out_ && system().system().move_supports_on(share);
}

std::optional<Stepper::Way> StaticIteration::way() const {
  const Evaluation& now = system().last();
  return way_.up_to(share_of_supports(), now.R.span(), now.trial->reactions, first_half(std::as_const(*y_).span()));
}

// Evaluates Q_s at s = load_.to(), to which share of their way supports have gone.
bool StaticIteration::evaluate(double t, ConstVec u, Vector& Q) {
  if (!system().out_of_balance(t, u, Q.span())) return false;
  add_to(Q, load_.to() - 1);
  return true;
}

// Adds share Q(u₀) to Q.
void StaticIteration::add_to(Vector& Q, double share) const {
  if (share == 0) return;
  for_each_index(Q.size(),
                 [=, Q = Q.span().data(), Q0 = Q_begin_.span().data()](std::size_t i) { Q[i] += share * Q0[i]; });
}

bool StaticIteration::search(double t, Vec u_new) {
  constexpr int most_trials = 25;
  double first = direction(p_.span());
  double slope = dot(Q_, p_);
  if (!(slope > 0)) {
    forget();
    first = direction(p_.span());
    slope = dot(Q_, p_);
  }
  LineSearch line(slope, sigma_, first);
  const ConstVec u = first_half(std::as_const(state()).span()), p = std::as_const(p_).span();
  for (int trial = 0; trial < most_trials; ++trial) {
    alpha_ = line.alpha();
    for_each_index(u.size(), [=, alpha = alpha_](std::size_t i) { u_new[i] = u[i] + alpha * p[i]; });
    if (!evaluate(t, u_new, next_Q_)) {
      if (refusal_.empty()) refusal_ = system().system().diagnosis().refusal(*system().last().trial);
      line.refused();
    } else if (line.done(dot(next_Q_, p_))) {
      return true;
    }
  }
  return false;
}

void StaticIteration::accepted() {
  if (!went_downhill_) return;
  std::swap(Q_, next_Q_);
  system().mass().solve(Q_.span(), z_.span());
  moved(alpha_);
  ++steps_of_this_;
  const bool is_last = load_.to() >= 1;  // the run itself ends the last increment
  if (!is_last && relative(norm(Q_), system().force_scale()) <= tolerance_) end_increment();
}

void StaticIteration::end_increment() {
  system().accept(system().last().t, state().span(), /*force_is_current=*/true);
  way_.go_on(share_of_supports(), system().last().R.span(), system().last().trial->reactions,
             first_half(std::as_const(state()).span()));
  if (steps_of_first_ == 0) steps_of_first_ = steps_of_this_;
  const double s = load_.to();
  load_.reached(/*easily=*/steps_of_this_ <= steps_of_first_);
  is_lost_ = !begin_increment(system().last().t, s, first_half(std::as_const(state()).span()));
}

// Needs Q_ to be Q_s at u, the place of the last evaluation. False if supports go on so far, even in the smallest
// increment, that the state cannot be evaluated.
bool StaticIteration::begin_increment(double t, double s, ConstVec u) {
  std::ranges::copy(u, u_begin_.span().begin());
  if (!move_supports_on(load_.to())) {
    add_to(Q_, load_.to() - s);
  } else {
    while (!evaluate(t, u, Q_)) {
      if (!load_.halve()) return false;
      move_supports_on(load_.to());
    }
  }
  system().mass().solve(Q_.span(), z_.span());
  unbalanced_at_begin_ = norm(Q_);
  steps_of_this_ = 0;
  load_changed();
  return true;
}

// Whether the increment has taken many times the steps of the first one and is still out of balance.
bool StaticIteration::makes_no_way() const {
  constexpr long patience = 10, few = 50;
  constexpr double hardly = 1e-2;
  return steps_of_first_ > 0 && steps_of_this_ > patience * std::max(few, steps_of_first_) &&
         norm(Q_) > hardly * unbalanced_at_begin_;
}

// Whether the increment is balanced as far as rounding allows.
bool StaticIteration::is_as_good_as_balanced() const {
  constexpr double rounding = 1e-6;
  return norm(Q_) <= rounding * unbalanced_at_begin_;
}

// Goes back to the beginning of the increment and halves it. False if it is as small as may be, or if the body has no
// history: an elastic body that takes no more of the load would continue to where its springs have given way, as small
// as its forces are beside others.
bool StaticIteration::begin_half(double t, Vec u_new) {
  if (!system().system().history_dependent() || !load_.halve()) return false;
  forget();
  std::ranges::copy(std::as_const(u_begin_).span(), u_new.begin());
  move_supports_on(load_.to());
  if (!evaluate(t, u_new, Q_) || !begin_increment(t, load_.to(), u_new)) return false;
  went_downhill_ = false;
  return true;
}

std::string StaticIteration::failure() {
  return fmt::format(
      "{}the line search finds no state that is more in balance; the out-of-balance force is largest at {}{}",
      load_.is_divided() ? fmt::format("no equilibrium beyond the load factor {:.4g}: ", load_.from()) : "",
      largest_at(system().system(), std::as_const(Q_).span()), refusal_.empty() ? "" : "; on the way, " + refusal_);
}

}  // namespace stillpoint
