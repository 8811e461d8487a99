#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"
#include "solvers/statics/last_increment.hpp"
#include "solvers/statics/load_increments.hpp"
#include "solvers/statics/newton_direction.hpp"
#include "system/largest_at.hpp"
#include "system/static_balance.hpp"

namespace stillpoint {
namespace {

class Newton {
 public:
  Newton(SemiDiscrete& system, double t, Vec u, const NewtonOptions& options)
      : system_(system),
        u_(u),
        options_(options),
        supports_set_out_(is_undisplaced(u)),
        balance_(system, t, VectorSpace()),
        direction_(system, t, options, balance_, report_),
        trial_(u.size()) {}

  StaticReport solve() {
    system_.move_supports_on(supports_set_out_ ? 0 : 1);
    if (!balance_.start(u_)) {
      report_.reason = "the state at the start cannot be evaluated: " + system_.diagnosis().refusal(balance_.trial());
      return finished();
    }
    tell_equilibrium(0, u_);
    std::vector<double> u(u_.begin(), u_.end());
    LoadIncrements load({1.0 / options_.load_steps, options_.max_load_step, options_.min_load_step,
                         options_.sets_out_small && supports_set_out_});
    while (!load.at_end()) {
      LoadStep& step = report_.load_steps.emplace_back();
      step.from = load.from();
      step.to = load.to();
      std::ranges::copy(u_, u.begin());
      if (load_step(step, u)) {
        if (system_.history_dependent()) last_.remember(step.to - step.from, u_, u);
        std::ranges::copy(u, u_.begin());
        report_.load_factor = step.to;
        tell_equilibrium(step.to, u_);
        if (system_.history_dependent()) system_.commit(balance_.trial());
        refused_ = false;
        constexpr std::size_t easy = 9;
        load.reached(step.residuals.size() <= easy);
      } else if (!load.halve()) {
        if (!refused_ || !options_.accept_unstable) {
          report_.reason =
              fmt::format("no equilibrium beyond the load factor {:.4g}: {}, {}; load step {:.3g} < {:.3g}", step.from,
                          report_.reason, worst(step.to, u), load.size(), options_.min_load_step);
          return finished();
        }
        load.begin_anew();
        accepts_ = std::exchange(refused_, false);
      }
    }
    report_.converged = true;
    return finished();
  }

 private:
  // The forces at a load factor: supports have gone that share of their way, so that points do not remember it as one
  // strain of the cells beside them. They stay where they are if the body is displaced, as by an earlier solution.
  bool evaluate(double s, ConstVec u) {
    system_.move_supports_on(supports_set_out_ ? s : 1);
    return balance_.evaluate(s, u);
  }
  void tell_equilibrium(double s, ConstVec u) {
    if (options_.at_equilibrium)
      options_.at_equilibrium(s, std::as_const(balance_).R().span(), balance_.trial().reactions, u);
  }
  // u: the state at step.from, then the equilibrium at step.to; if there is none, report_.reason says why. A slender
  // body has a valley of bent states between walls of stretched ones: a search that asks each step for a smaller ‖Q‖
  // crawls along it, while full steps cross the walls and come down on the other side, soonest with the stresses that
  // the tangent predicts in K, since the stretch of a wall is the next step's to take back. Points that yield would
  // remember the end of such a detour: beyond a limit load it may be an equilibrium that no path of the load reaches.
  bool load_step(LoadStep& step, Vec u) {
    const std::vector<double> start(u.begin(), u.end());
    refusal_.clear();
    if (last_.is_known()) {
      const double share = step.to - step.from;
      last_.extrapolate(share, u);
      if (iterate(step, u) && last_.is_like(share, start, u)) return true;
      std::ranges::copy(start, u.begin());
      step.converged = false;
      step.residuals.clear();
    }
    if (iterate(step, u)) return true;
    if (!full_steps_ && !crawls_) return false;
    // The other kind of steps; where full ones were the better kind they are what the next increment begins with.
    std::ranges::copy(start, u.begin());
    step.residuals.clear();
    full_steps_ = !full_steps_;
    return iterate(step, u);
  }

  bool iterate(LoadStep& step, Vec u) {
    short_steps_ = 0;
    crawls_ = false;
    double residual = evaluate(step.to, u) ? balance_.residual() : std::numeric_limits<double>::quiet_NaN();
    step.residuals.push_back(residual);
    direction_.begin_load_step();
    for (int iteration = 0; !(residual <= options_.tolerance); ++iteration) {
      if (!full_steps_ && short_steps_ >= most_short_steps) crawls_ = !system_.history_dependent();
      const bool strays = full_steps_ && iteration >= patience && !(residual < step.residuals.front());
      if (iteration == options_.max_iterations || !std::isfinite(residual) || crawls_ || strays) {
        report_.reason = fmt::format("residual {:.3g} > tolerance {:.3g} after {} iterations", residual,
                                     options_.tolerance, iteration);
        return false;
      }
      heed_stop_request();
      ++report_.iterations;
      const double before = residual;
      const bool predicts = full_steps_ && iteration > 0;
      const bool nearer =
          direction_.find(step.to, u, predicts ? ConstVec(from_) : ConstVec()) && descend(step.to, u, before);
      if (!nearer && before <= options_.near_enough) {
        evaluate(step.to, u);
        break;
      }
      if (!nearer) {
        // Opening or just yielding points may leave K singular; K_e never is in a body that is held.
        ++report_.elastic_iterations;
        if (!evaluate(step.to, u) || !direction_.find_elastic(u) || !descend(step.to, u, residual)) {
          crawls_ = !full_steps_ && !system_.history_dependent();
          report_.reason = fmt::format("no step from the residual {:.3g} makes it smaller{}", residual,
                                       refusal_.empty() ? "" : "; on the way, " + refusal_);
          return false;
        }
      }
      residual = balance_.residual();
      step.residuals.push_back(residual);
      constexpr double decrease_of_linear_system = 1e-6;
      if (!(residual <= decrease_of_linear_system * before)) direction_.forget_new_factor();
      constexpr double least_decrease = 0.9;
      if (residual <= options_.near_enough && residual > least_decrease * before) break;
    }
    if (direction_.indefinite() && !accepts_) {
      refused_ = true;
      report_.reason = "the equilibrium found is unstable: K is indefinite";
      return false;
    }
    step.converged = true;
    report_.residual = residual;
    report_.reason = residual <= options_.tolerance
                         ? fmt::format("residual {:.3g} <= tolerance {:.3g}", residual, options_.tolerance)
                         : fmt::format("residual {:.3g} > tolerance {:.3g}, as small as rounding lets it become",
                                       residual, options_.tolerance);
    return true;
  }

  // Describes the obstacle to balance at u: the place that cannot be evaluated, or the largest out-of-balance force.
  std::string worst(double s, ConstVec u) {
    if (!evaluate(s, u)) return "where the state cannot be evaluated: " + system_.diagnosis().refusal(balance_.trial());
    return "largest at " + largest_at(system_, std::as_const(balance_.Q).span());
  }

  // Takes u += λ du with the first of λ = 1, ½, ¼, … that makes ‖Q‖ small enough; u stays if none does.
  bool descend(double s, Vec u, double before) {
    constexpr int most_halvings = 10;
    constexpr double decrease = 1e-4;
    for (int halvings = 0; halvings < most_halvings; ++halvings) {
      const double lambda = std::ldexp(1, -halvings);
      for (std::size_t i = 0; i < u.size(); ++i) trial_[i] = u[i] + lambda * direction_.du()[i];
      if (!evaluate(s, trial_)) {
        if (refusal_.empty()) refusal_ = system_.diagnosis().refusal(balance_.trial());
        continue;
      }
      if (!full_steps_ && !(balance_.residual() <= (1 - decrease * lambda) * before)) continue;
      from_.assign(u.begin(), u.end());
      std::ranges::copy(trial_, u.begin());
      short_steps_ = lambda < short_step ? short_steps_ + 1 : 0;
      return true;
    }
    return false;
  }

  StaticReport finished() {
    system_.move_supports_on(1);
    report_.force_evaluations = balance_.evaluations;
    report_.wall_s = watch_.seconds();
    if (!report_.converged)
      report_.residual = evaluate(1, u_) ? balance_.residual() : std::numeric_limits<double>::quiet_NaN();
    return report_;
  }

  const Stopwatch watch_;
  SemiDiscrete& system_;
  Vec u_;
  const NewtonOptions& options_;
  const bool supports_set_out_;
  StaticBalance balance_;
  StaticReport report_;
  NewtonDirection direction_;
  std::vector<double> trial_, from_;  // the state that the next step would lead to, and the one that the last led from
  LastIncrement last_;                // known if the points have a history
  static constexpr int most_short_steps = 3;
  static constexpr double short_step = 0.3;
  static constexpr int patience = 12;  // full steps that need not have led anywhere; slender beams take up to ten
  bool full_steps_ = false;            // full steps are taken, whatever ‖Q‖ does
  int short_steps_ = 0;                // short steps in succession
  bool crawls_ = false;   // the search of the last iterate() came to an end, or nearly, and full steps may do better
  std::string refusal_;   // why the first state of this load step that could not be evaluated was refused
  bool refused_ = false;  // an equilibrium was refused since the last one taken
  bool accepts_ = false;  // indefinite equilibria are accepted
};

}  // namespace

std::string NewtonOptions::validate() const {
  if (!(tolerance > 0)) return fmt::format("tolerance = {}, expected > 0", tolerance);
  if (!(near_enough >= 0)) return fmt::format("near_enough = {}, expected ≥ 0", near_enough);
  if (max_iterations < 1) return fmt::format("max_iterations = {}, expected ≥ 1", max_iterations);
  if (load_steps < 1) return fmt::format("load_steps = {}, expected ≥ 1", load_steps);
  if (!(max_load_step > 0)) return fmt::format("max_load_step = {}, expected > 0", max_load_step);
  if (!(min_load_step > 0)) return fmt::format("min_load_step = {}, expected > 0", min_load_step);
  if (!(symmetry >= 0)) return fmt::format("symmetry = {}, expected ≥ 0", symmetry);
  if (max_cg_iterations < 0) return fmt::format("max_cg_iterations = {}, expected ≥ 0", max_cg_iterations);
  return "";
}

StaticReport newton(SemiDiscrete& system, double t, Vec u, const NewtonOptions& options) {
  if (const std::string wrong = options.validate(); !wrong.empty()) throw std::invalid_argument(wrong);
  return Newton(system, t, u, options).solve();
}

}  // namespace stillpoint
