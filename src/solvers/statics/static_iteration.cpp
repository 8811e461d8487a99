#include "solvers/statics/static_iteration.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/parallel_loop.hpp"
#include "system/largest_at.hpp"

namespace stillpoint {

StaticIteration::StaticIteration(double max_step, RelaxationSystem& system, LineSearch::Accuracy sigma)
    : SteppingIntegrator({.max_step = max_step}, system),
      sigma_(sigma),
      Q_(system.vectors().make(system.size())),
      z_(system.vectors().make(system.size())),
      next_Q_(system.vectors().make(system.size())),
      p_(system.vectors().make(system.size())) {
  if (system.system().contact()) {
    throw std::invalid_argument(
        "in a static solution nothing that touches the body can open or close: take relaxation");
  }
}

void StaticIteration::begin(double t, const Vector& /*y*/) {
  forget();
  admissible_ = system().out_of_balance(t, first_half(std::as_const(state()).span()), Q_.span());
  if (admissible_) system().mass().solve(Q_.span(), z_.span());
}

SteppingIntegrator::Attempt StaticIteration::attempt(double t, Vector& y, double h, double /*t_stop*/, Vector& trial) {
  if (!admissible_) return {.status = StepReport::Status::inadmissible};
  const Vec u_new = first_half(trial.span());
  std::ranges::copy(first_half(std::as_const(y).span()), u_new.begin());
  std::ranges::fill(second_half(trial.span()), 0.0);
  moves_ = dot(Q_, z_) > 0;
  if (!moves_) return {.h = h};  // in balance to the last bit
  if (search(t, u_new)) return {.h = h};
  forget();  // what was remembered may have been of no use: straight downhill
  if (search(t, u_new)) return {.h = h};
  // The last evaluation has to be that of the state.
  system().out_of_balance(t, first_half(std::as_const(y).span()), Q_.span());
  return {.status = StepReport::Status::failed,
          .h = h,
          .message = "the line search finds no state that is more in balance; the out-of-balance force is largest at " +
                     largest_at(system().system(), std::as_const(Q_).span())};
}

void StaticIteration::archive_memory(const StateArchive& state) {
  state("Q", Q_.span());
  state("z", z_.span());
  state("p", p_.span());
  archive_method(state);
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
    if (!system().out_of_balance(t, u_new, next_Q_.span())) {
      line.refused();
    } else if (line.done(dot(next_Q_, p_))) {
      return true;
    }
  }
  return false;
}

void StaticIteration::accepted() {
  if (!moves_) return;
  std::swap(Q_, next_Q_);
  system().mass().solve(Q_.span(), z_.span());
  moved(alpha_);
}

}  // namespace stillpoint
