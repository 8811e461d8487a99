// Newton's method as one step of a simulation: from the state that it begins in to the equilibrium under the full load.
#include <stillpoint/static_solution.hpp>

#include <algorithm>
#include <utility>

#include "solvers/spectrum/direct_solver_limit.hpp"
#include "solvers/statics/static_methods.hpp"
#include "solvers/statics/static_way.hpp"
#include "solvers/statics/without_time.hpp"
#include "system/static_balance.hpp"

namespace stillpoint {
namespace {

class NewtonStep final : public WithoutTime<Stepper> {
 public:
  NewtonStep(const NewtonOptions& options, RelaxationSystem& system)
      : WithoutTime(system), options_(options), tolerance_(options.tolerance) {}

  void start(double t, Vector& y) override {
    t_ = t;
    y_ = &y;
  }
  // Solves at the t of the start, as time does not advance. A second step solves once more, from the last answer and to
  // a smaller residual.
  StepReport step(double /*t_stop*/) override {
    const bool supports_set_out = is_undisplaced(first_half(std::as_const(state()).span()));
    options_.at_equilibrium = [this, supports_set_out](double s, ConstVec R, ConstVec reactions, ConstVec u) {
      const double share = supports_set_out ? s : 1;
      if (s == 0) return way_.begin(share, R, reactions, u);
      way_.go_on(share, R, reactions, u);
    };
    const StaticReport report = newton(system().system(), t_, first_half(state().span()), options_);
    steps_ += report.iterations;
    system().count_evaluations(report.force_evaluations + report.tangent_products);
    std::ranges::fill(second_half(state().span()), 0.0);
    constexpr double smaller = 1e-2, rounding = 1e-14;
    options_.tolerance = std::clamp(smaller * report.residual, rounding, options_.tolerance);
    // Forces that have changed may be in balance as they are: those of multipliers that were right at once.
    const bool may_stay = std::exchange(forces_changed_, false) || steps_ == 0;
    const bool moved = report.iterations > 0 || may_stay;
    if (report.converged && moved) return {.t = t_, .message = report.reason};
    return {.status = StepReport::Status::failed,
            .t = t_,
            .message = report.converged ? "Newton's method comes no nearer: " + report.reason : report.reason};
  }
  void take_changed_forces(double /*t*/) override {
    options_.tolerance = tolerance_;
    forces_changed_ = true;
  }
  void set_max_step(double /*h*/) override {}
  std::optional<Way> way() const override { return way_.so_far(); }
  void archive(const StateArchive& state) override {
    state("iterations", steps_, "forces_changed", forces_changed_);
    way_.archive(state.part("way"), system().size(), system().last().trial->reactions.size());
  }

 private:
  NewtonOptions options_;
  double tolerance_;             // of the first answer
  bool forces_changed_ = false;  // since then
  double t_ = 0;
  StaticWay way_;
};

}  // namespace

NewtonOptions newton_options(std::string_view name, int load_steps) {
  NewtonOptions options;
  options.solver = linear_solver_of(name);
  options.load_steps = load_steps;
  options.max_load_step = 1.0 / load_steps;
  return options;
}

void precondition(NewtonOptions& options, const Mass& M) {
  options.preconditioner = [&M](ConstVec r, Vec Br) { M.solve(r, Br); };
  options.assembles = true;
}

std::unique_ptr<Stepper> make_newton(const StaticMethodOptions& options, RelaxationSystem& system) {
  NewtonOptions of_newton = newton_options(options.name, options.load_steps);
  of_newton.tolerance = options.tolerance;
  of_newton.sets_out_small = options.closes_with_friction;
  if (system.keeps_momentum()) precondition(of_newton, system.mass());
  // The run itself tests the final state for stability, and says what is wrong with it.
  of_newton.accept_unstable = !system.system().history_dependent() && system.size() <= direct_solver_limit;
  return std::make_unique<NewtonStep>(of_newton, system);
}

}  // namespace stillpoint
