// Relaxation that finds its own damping, with no number from the user.
//
//   M a = Q − c M v,   c = 2 √(vᵀΔR/(h vᵀMv)), the global quotient of adaptive damping, one scalar
//
// The step given is a safe share of the critical one. What may go wrong is watched for:
//
//   overshoot    v·Q < 0, the motion as a whole goes uphill:  v = 0
//   stall        √(QᵀM⁻¹Q) has not halved in three periods of the slowest motion seen:  c = 0 from then on, so that
//                the halts alone take energy out, which is kinetic damping; back to adapting if that stalls as well
//   instability  h² vᵀΔR/(h vᵀMv) > 4 · 0.925, which no stable motion shows, in a motion that grows:
//                ω_max was underestimated or has become more;  v = 0 and a shorter step
//
// If the loads depend on t the residual need not fall and a halt would be felt: then c alone is adapted.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solvers/relaxation/rayleigh_quotient.hpp"
#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class Auto final : public StaggeredIteration {
 public:
  Auto(const RelaxationOptions& options, RelaxationSystem& system)
      : StaggeredIteration(options, system),
        steady_(options.steady),
        c_(options.from.rate.value_or(0)),
        share_(options.from.step_share > 0 ? options.from.step_share : 1) {}

  std::optional<double> damping_rate() const override { return c_; }

 private:
  double step_share() const override { return share_; }

  // share_ only changes at a halt, so that h⁻ was of the same share.
  void propose(double step, Vec u_new, Vec v_new) override {
    const double k = share_ * kick(step);
    kick_and_drift(leapfrog(std::min(c_, 2 / k), k), k, share_ * step, u_new, v_new);
  }

  void moved(double step) override {
    ++steps_;
    const double h = share_ * step;
    const double quotient = global_quotient(v(), last_Q(), Q(), h, mass_dot(v(), v()), work());
    c_ = kinetic_ ? 0 : 2 * std::sqrt(quotient);
    set_rate(c_);
    const double unbalanced = std::sqrt(std::max(0.0, dot(Q(), a())));
    least_ = std::min(least_, unbalanced);
    if (is_unstable(quotient, h, unbalanced)) return;
    if (steady_) watch(quotient, h, unbalanced);
  }

  // At equilibrium the quotient is rounding and may be anything: an instability also grows.
  bool is_unstable(double quotient, double h, double unbalanced) {
    constexpr double most = 4 * 0.925, aim = 4 * 0.85;  // of h² ω²
    constexpr double growth = 10;
    const double reached = h * h * quotient;
    if (reached <= most || unbalanced < growth * least_) return false;
    share_ *= std::sqrt(aim / reached);
    halt();
    return true;
  }

  void archive_strategy(const StateArchive& state) override {
    state("c", c_);
    state("share", share_);
    state("kinetic", kinetic_);
    state("least", least_);
    state("steps_taken", steps_);
    state("halted_at", halted_at_);
    state("watched_from", watched_from_);
    state("goal", goal_);
    state("slowest", slowest_);
  }

  void watch(double quotient, double h, double unbalanced) {
    if (!(unbalanced > goal_)) begin_watch(unbalanced);
    if (quotient > 0) slowest_ = std::min(slowest_, quotient);
    constexpr int settling = 3;  // steps after a halt in which v is of no direction yet
    if (steps_ - halted_at_ >= settling && dot(v(), Q()) < 0) halt();

    constexpr double periods = 3, fewest = 500;
    const double patience = std::max(fewest, periods * 2 * std::numbers::pi / (std::sqrt(slowest_) * h));
    if (static_cast<double>(steps_ - watched_from_) < patience) return;
    kinetic_ = !kinetic_;
    halt();
    begin_watch(unbalanced);
  }

  void begin_watch(double unbalanced) {
    goal_ = unbalanced / 2;
    watched_from_ = steps_;
    slowest_ = std::numeric_limits<double>::infinity();
  }

  void halt() {
    stop();
    halted_at_ = steps_;
  }

  bool steady_;
  double c_;      // [1/s]
  double share_;  // of the step given
  bool kinetic_ = false;
  double least_ = std::numeric_limits<double>::infinity();  // √(QᵀM⁻¹Q) so far
  long steps_ = 0, halted_at_ = 0, watched_from_ = 0;
  double goal_ = std::numeric_limits<double>::infinity();     // the √(QᵀM⁻¹Q) to come below next
  double slowest_ = std::numeric_limits<double>::infinity();  // least quotient since the watch began [1/s²]
};

}  // namespace

std::unique_ptr<Integrator> make_auto(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Auto>(options, system);
}

}  // namespace stillpoint
