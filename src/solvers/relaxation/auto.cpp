// Relaxation that chooses its own method and parameters, with no number from the user.
//
// If only equilibrium is asked for, of a body without history, without walls that open and in a single phase, the steps
// are those of a conjugate descent (conjugate_descent.hpp), which needs fewer of them than any damped motion: iterates
// without a velocity. In all other cases, and after the descent has found no way on, has twice within a few steps led
// to a state that cannot be evaluated, or has not halved √(QᵀM⁻¹Q) for long, it is a damped motion
//
//   M a = Q − c M v,   c = 2 √(vᵀΔR/(h vᵀMv)), the global quotient of adaptive damping, one scalar
//
// from which the descent is taken up again after 50 steps, 100, 200, ... The step given is a safe share of the critical
// one. Three failures of the motion are watched for:
//
//   overshoot    v·Q < 0, the motion as a whole goes uphill:  v = 0
//   stall        √(QᵀM⁻¹Q) has not halved in three periods of the slowest motion seen:  c = 0 from then on, so that
//                the halts alone take energy out, which is kinetic damping; back to adapting if that stalls as well
//   instability  h² vᵀΔR/(h vᵀMv) > 4 · 0.925, which no stable motion shows, in a motion that grows:
//                ω_max was underestimated or has become more;  v = 0 and a shorter step
//
// If the loads depend on t the residual need not fall and a halt would disturb the motion: then only c is adapted.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel_loop.hpp"
#include "solvers/relaxation/conjugate_descent.hpp"
#include "solvers/relaxation/rayleigh_quotient.hpp"
#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class Auto final : public StaggeredIteration {
 public:
  Auto(const RelaxationOptions& options, RelaxationSystem& system)
      : StaggeredIteration(options, system),
        may_descend_(options.steady && options.single_phase &&
                     !options.path_dependent.value_or(system.system().history_dependent()) &&
                     !system.system().contact()),
        descends_(may_descend_),
        mass_is_lumped_(system.system().mass().is_lumped()),
        steady_(options.steady),
        c_(options.from.rate.value_or(0)),
        share_(options.from.step_share > 0 ? options.from.step_share : 1) {
    if (may_descend_) descent_.emplace(system.vectors(), system.mass(), options.linear);
  }

  bool moves() const override { return !descends_; }
  std::optional<double> lowest_frequency() const override {
    const std::optional<double> squared = descends_ ? descent_->lowest() : std::nullopt;
    return squared ? std::optional(std::sqrt(*squared)) : std::nullopt;
  }
  // ‖F − R‖ is known only for a lumped mass: with another one Q contains the inertia of moving supports.
  Known known() const override {
    Known known = StaggeredIteration::known();
    if (descends_ && known.force && mass_is_lumped_) known.unbalanced_force = descent_->unbalanced_force();
    return known;
  }

 private:
  std::optional<double> rate() const override { return descends_ ? std::nullopt : std::optional(c_); }
  double step_share() const override { return share_; }
  bool keeps_v() const override { return descends_; }  // the descent stays at rest
  // Finite forces everywhere give a finite acceleration.
  std::optional<bool> tried(const Vector& Q, const Vector& a) override {
    if (!descends_) return std::nullopt;
    descent_->look_at(Q, a);
    return std::isfinite(descent_->unbalanced_force());
  }

  void on_restart() override {
    if (!descends_) return;
    stop();
    descent_->begin_again(Q(), a(), options().max_step * options().max_step / 4);
  }

  // share_ changes only at a halt, so that h⁻ was scaled by the same share.
  void propose(double step, Vec u_new, Vec v_new) override {
    if (descends_) {
      descend(step, u_new);
      return;
    }
    const double k = share_ * kick(step);
    kick_and_drift(leapfrog(std::min(c_, 2 / k), k), k, share_ * step, u_new, v_new);
  }

  // Time advances by the step given; the way is shortened if all of it leads to a state that cannot be evaluated.
  void descend(double step, Vec u_new) {
    if (!std::exchange(is_tried_, true)) full_step_ = step;
    const double share = step / full_step_;
    is_cut_ = share < 1;
    for_each_index(u_new.size(), [=, u = u().span().data(), way = descent_->way().data()](std::size_t i) {
      u_new[i] = u[i] + share * way[i];
    });
  }

  // The descent begins with the step 1/ω_max².
  void begin_descent() { descent_->begin(Q(), a(), options().max_step * options().max_step / 4); }

  void descended(double step) {
    is_tried_ = false;
    if (is_cut_) {
      constexpr long few = 20;
      const bool again = cut_at_ > 0 && steps_ - cut_at_ < few;
      cut_at_ = steps_;
      if (again) {
        leave_descent();
        return;
      }
      begin_descent();
    } else if (!descent_->evaluated(Q(), a())) {
      leave_descent();
      return;
    }
    if (!(descent_->unbalanced() > goal_)) begin_watch(descent_->unbalanced());
    if (descent_->quotient() > 0) slowest_ = std::min(slowest_, descent_->quotient());
    if (is_stalled(share_ * step)) leave_descent();
  }

  void leave_descent() {
    descends_ = false;
    left_at_ = steps_;
    apart_ *= 2;
    halt();
    begin_watch(unbalanced());
  }

  // Takes up the descent if the stiffness along the motion is positive.
  bool takes_up_descent(double quotient) {
    if (!may_descend_ || !(quotient > 0) || steps_ - left_at_ < apart_) return false;
    descends_ = true;
    stop();
    begin_watch(unbalanced());
    begin_descent();
    return true;
  }

  void moved(double step) override {
    ++steps_;
    if (descends_) {
      descended(step);
      return;
    }
    const double h = share_ * step;
    const double quotient = global_quotient(v(), last_Q(), Q(), h, energy(), work());
    c_ = kinetic_ ? 0 : 2 * std::sqrt(quotient);
    set_rate(c_, h);
    const double unbalanced = this->unbalanced();
    least_ = std::min(least_, unbalanced);
    if (is_unstable(quotient, h, unbalanced)) return;
    if (takes_up_descent(quotient)) return;
    if (steady_) watch(quotient, h, unbalanced);
  }

  double unbalanced() const { return std::sqrt(std::max(0.0, dot(Q(), a()))); }  // √(QᵀM⁻¹Q)

  // At equilibrium the quotient is rounding and may be anything: an instability also grows. When a support begins to
  // move or a load is applied, a body at rest shows a far larger quotient for one step, from a force that its motion
  // has no part in.
  bool is_unstable(double quotient, double h, double unbalanced) {
    constexpr double most = 4 * 0.925, aim = 4 * 0.85, doubtful = 16;  // of h² ω²: the limit, the aim, a doubtful value
    constexpr double growth = 10;
    const double reached = h * h * quotient;
    if (reached <= most || unbalanced < growth * least_) {
      is_in_doubt_ = false;
      return false;
    }
    if (!steady_ && reached > doubtful && !std::exchange(is_in_doubt_, true)) return false;
    is_in_doubt_ = false;
    share_ *= std::sqrt(aim / reached);
    halt();
    return true;
  }

  void archive_strategy(const StateArchive& state) override {
    state("c", c_);
    state("share", share_);
    state("kinetic", kinetic_);
    state("descends", descends_);
    state("cut_at", cut_at_);
    state("left_at", left_at_);
    state("apart", apart_);
    if (descent_) descent_->archive(state.part("descent"));
    state("least", least_);
    state("is_in_doubt", is_in_doubt_);
    state("steps_taken", steps_);
    state("halted_at", halted_at_);
    state("watched_from", watched_from_);
    state("goal", goal_);
    state("slowest", slowest_);
  }

  void watch(double quotient, double h, double unbalanced) {
    if (!(unbalanced > goal_)) begin_watch(unbalanced);
    if (quotient > 0) slowest_ = std::min(slowest_, quotient);
    constexpr int settling = 3;  // steps after a halt before v has a meaningful direction
    if (steps_ - halted_at_ >= settling && dot(v(), Q()) < 0) halt();

    if (!is_stalled(h)) return;
    kinetic_ = !kinetic_;
    halt();
    begin_watch(unbalanced);
  }

  bool is_stalled(double h) const {
    constexpr double periods = 3, fewest = 500;
    const double patience = std::max(fewest, periods * 2 * std::numbers::pi / (std::sqrt(slowest_) * h));
    return static_cast<double>(steps_ - watched_from_) >= patience;
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

  bool may_descend_, descends_, mass_is_lumped_;
  std::optional<ConjugateDescent> descent_;  // if the descent may be used
  bool is_tried_ = false, is_cut_ = false;   // this step was tried before; its last trial was shortened
  double full_step_ = 0;                     // length of the step's first trial [s]
  long cut_at_ = 0;                          // last step that was shortened
  long left_at_ = 0, apart_ = 25;            // step at which the descent was left, and steps to wait before it resumes
  bool steady_;
  double c_;      // [1/s]
  double share_;  // taken share of the step given
  bool kinetic_ = false;
  double least_ = std::numeric_limits<double>::infinity();  // least √(QᵀM⁻¹Q) so far
  bool is_in_doubt_ = false;                                // the last step looked unstable by far
  long steps_ = 0, halted_at_ = 0, watched_from_ = 0;
  double goal_ = std::numeric_limits<double>::infinity();     // √(QᵀM⁻¹Q) to fall below next
  double slowest_ = std::numeric_limits<double>::infinity();  // least quotient since the watch began [1/s²]
};

}  // namespace

std::unique_ptr<Stepper> make_auto(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Auto>(options, system);
}

}  // namespace stillpoint
