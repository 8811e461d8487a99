// The only file that calls ARKODE's integrators. It also takes care of the following (measured on 6.4.1):
//
//   - a table with c_s = 1 that is not first-same-as-last is integrated wrongly: post_process() below makes it right
//   - a fixed step has error weights of DBL_MIN, so that norms run on denormals: constant weights of 1
//   - a fixed step never reports trouble: TrialStepper looks at every new state
//   - a trial that cannot be evaluated is fatal: reset to the last good state, and the caller tries a smaller step
//   - an exception cannot cross C: it is kept and thrown again on this side
//
// Kinetic damping is an event: the kinetic energy K has its peak where dK/dt = vᵀMv' = v·Q falls through 0, which
// ARKODE's root finding places inside the step. The step ends there, v is set to 0 and ARKODE begins anew from that
// state. The root function costs a force evaluation each time that it is asked, and is counted.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "linalg/sundials.hpp"
#include "solvers/integrators/arkode_tables.hpp"
#include "solvers/integrators/integrator_families.hpp"
#include "solvers/integrators/march.hpp"

namespace stillpoint {
namespace {

namespace ark = sundials;

// Whether ARKODE takes the table for first-same-as-last although it is not.
bool is_mistaken_for_fsal(const ButcherTable& table) {
  return ark::reuses_last_stage_wrongly && std::abs(table.c.back() - 1) < 1e-10 && !first_same_as_last(table);
}

class Erk final : public March {
 public:
  Erk(const IntegratorOptions& options, RelaxationSystem& system)
      : March(options, system),
        table_(erk_table(options.method)),
        kinetic_(options.halts_at_energy_peaks),
        Q_(system.vectors().make(kinetic_ ? system.size() : 0)),
        v_(system.keeps_momentum() ? system.vectors().like(Q_) : system.vectors().view(Q_.span())) {}
  Erk(const Erk&) = delete;
  Erk& operator=(const Erk&) = delete;
  ~Erk() override {
    if (!arkode_) return;
    ark::release_messages(context_);
    ark::Free(&arkode_);
  }

 private:
  bool begin(double t, const Vector& y) override {
    if (!arkode_) {
      create(t, y);
    } else {
      check(ERKStepReInit(arkode_, right_hand_side, t, y.handle()), "ERKStepReInit");
      if (adaptive()) check(ark::SetInitStep(arkode_, 0), "SetInitStep");  // ARKODE's own estimate
    }
    refused_ = false;
    arkode_t_ = t;
    error_test_failures_ = 0;
    return true;
  }

  Attempt attempt(double t, Vector& y, double h, double t_stop, Vector& trial) override {
    if (refused_) check(ark::Reset(arkode_, t, y.handle()), "Reset");
    inadmissible_ = false;
    if (!adaptive()) {
      check(ark::SetFixedStep(arkode_, h), "SetFixedStep");
    } else {
      if (refused_) check(ark::SetInitStep(arkode_, std::min(h, t_stop - t)), "SetInitStep");
      check(ark::SetStopTime(arkode_, t_stop), "SetStopTime");
    }
    if (std::exchange(refused_, false)) arkode_t_ = t;

    double reached = t;
    const int code = ark::Evolve(arkode_, t_stop, trial.handle(), &reached, ARK_ONE_STEP);
    if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
    count_error_test_failures();
    if (code < 0) return failure(code, h);
    if (code == ARK_ROOT_RETURN) {
      std::ranges::fill(second_half(trial.span()), 0.0);
      refused();
      return {.h = reached - t, .t = reached};
    }
    if (adaptive()) check(ark::GetLastStep(arkode_, &h), "GetLastStep");
    // A good return code alone does not mean that the step was taken.
    const double came = reached - arkode_t_;
    if (!(std::abs(came - h) <= 1e-6 * h + rounding_of(t))) {
      refused();
      return {
          .status = StepReport::Status::failed, .h = h, .message = fmt::format("ARKODE stopped at t = {}", reached)};
    }
    arkode_t_ = reached;
    // ARKODE sums its steps; over very many of them its time drifts from the integrator's and is set anew.
    if (!adaptive() && std::abs(reached - (t + h)) > 1e-7 * h) refused();
    return {.h = h, .t = reached};
  }

  // ARKODE has moved on, or holds times and states of a rejected trial: it begins anew at the last good state.
  void refused() override { refused_ = true; }

  void max_step_changed() override {
    if (adaptive() && arkode_) check(ark::SetMaxStep(arkode_, options().max_step), "SetMaxStep");
  }

  Attempt failure(int code, double h) {
    refused();
    if (adaptive()) check(ark::GetCurrentStep(arkode_, &h), "GetCurrentStep");
    if (inadmissible_) return {.status = StepReport::Status::inadmissible, .h = h};
    if (code == ARK_TOO_MUCH_ACC && !adaptive()) {  // the norm with weights of 1, times the unit roundoff, is above 1
      return {
          .status = StepReport::Status::not_finite, .h = h, .message = "the state has grown past 4e15: it diverges"};
    }
    return {.status = StepReport::Status::failed, .h = h, .message = message_of(code)};
  }

  void create(double t, const Vector& y) {
    context_ = y.handle()->sunctx;
    arkode_ = ERKStepCreate(right_hand_side, t, y.handle(), context_);
    if (!arkode_) throw std::runtime_error("ARKODE: ERKStepCreate failed");
    check(ark::capture_messages(arkode_, context_, last_message_), "capture_messages");
    check(ark::SetUserData(arkode_, this), "SetUserData");
    check(ERKStepSetTable(arkode_, to_arkode(table_).get()), "ERKStepSetTable");
    if (kinetic_) {
      check(ark::set_hermite_interpolant(arkode_), "set_hermite_interpolant");
      check(ark::RootInit(arkode_, 1, power), "RootInit");
      int falling = -1;
      check(ark::SetRootDirection(arkode_, &falling), "SetRootDirection");
    } else {
      check(ark::set_cheapest_interpolant(arkode_), "set_cheapest_interpolant");
    }
    check(ark::SetMaxNumSteps(arkode_, -1), "SetMaxNumSteps");
    if (is_mistaken_for_fsal(table_)) check(ark::SetPostprocessStepFn(arkode_, post_process), "SetPostprocessStepFn");
    if (adaptive()) {
      Vector atol = system().vectors().like(y);  // ARKODE takes a copy
      std::ranges::fill(first_half(atol.span()), options().atol_u);
      std::ranges::fill(second_half(atol.span()), options().atol_v);
      check(ark::SVtolerances(arkode_, *options().rtol, atol.handle()), "SVtolerances");
      check(ark::SetMaxStep(arkode_, options().max_step), "SetMaxStep");
    } else {
      check(ark::WFtolerances(arkode_, unit_weights), "WFtolerances");
    }
  }

  void count_error_test_failures() {
    long failures = 0;
    check(ark::GetNumErrTestFails(arkode_, &failures), "GetNumErrTestFails");
    count_rejected(failures - std::exchange(error_test_failures_, failures));
  }

  // All SUNDIALS return codes are checked here.
  void check(int code, const char* call) const {
    if (code < 0) throw std::runtime_error(fmt::format("ARKODE: {} failed: {}", call, message_of(code)));
  }

  std::string message_of(int code) const {
    const std::unique_ptr<char, decltype(&std::free)> name(ark::GetReturnFlagName(code), &std::free);
    return fmt::format("{} ({}): {}", name ? name.get() : "error", code, last_message_);
  }

  static double rounding_of(double t) { return 100 * std::numeric_limits<double>::epsilon() * std::abs(t); }

  // y' = f(t, y) for C: 0 done, 1 cannot be evaluated at this y, −1 an exception was thrown.
  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector ydot, void* self) noexcept {
    auto& erk = *static_cast<Erk*>(self);
    try {
      const std::size_t n = 2 * erk.system().size();
      if (erk.system()(t, {N_VGetArrayPointer(y), n}, {N_VGetArrayPointer(ydot), n})) return 0;
      erk.inadmissible_ = true;
      return 1;
    } catch (...) {
      erk.exception_ = std::current_exception();
      return -1;
    }
  }

  // The root function dK/dt = v·Q for C: 0 done, 1 cannot be evaluated at this y, −1 an exception was thrown.
  static int power(sunrealtype t, N_Vector y, sunrealtype* value, void* self) noexcept {
    auto& erk = *static_cast<Erk*>(self);
    try {
      const ConstVec both(N_VGetArrayPointer(y), 2 * erk.system().size());
      erk.inadmissible_ = !erk.system().out_of_balance(t, first_half(both), erk.Q_.span());
      if (erk.inadmissible_) return 1;
      if (erk.system().keeps_momentum()) {
        erk.system().mass().solve(second_half(both), erk.v_.span());
      } else {
        N_VSetArrayPointer(N_VGetArrayPointer(y) + erk.system().size(), erk.v_.handle());
      }
      *value = dot(erk.Q_, erk.v_);
      return 0;
    } catch (...) {
      erk.exception_ = std::current_exception();
      return -1;
    }
  }

  // Does nothing, but while a post-processing function is set ARKODE evaluates f(t_n, y_n) afresh.
  static int post_process(sunrealtype, N_Vector, void*) noexcept { return 0; }

  // ARKODE asks for the weights every step; its weight vector keeps what was written once.
  static int unit_weights(N_Vector, N_Vector weights, void* self) noexcept {
    auto& erk = *static_cast<Erk*>(self);
    if (std::exchange(erk.weights_, weights) != weights) N_VConst(1, weights);
    return 0;
  }

  ButcherTable table_;
  bool kinetic_;
  Vector Q_, v_;  // work of power(), (n); v_ holds M⁻¹p, or is a view of v in the y that is asked for
  void* arkode_ = nullptr;
  SUNContext context_ = nullptr;
  N_Vector weights_ = nullptr;  // the vector that unit_weights() filled
  bool refused_ = false;        // ARKODE's state or time is not the last good one
  double arkode_t_ = 0;         // ARKODE's own time [s]
  bool inadmissible_ = false;
  std::exception_ptr exception_;
  long error_test_failures_ = 0;  // failed error tests of this ARKODE memory so far
  std::string last_message_;
};

}  // namespace

std::vector<Method> erk_methods() {
  std::vector<Method> methods;
  for (const auto& [table, source] : erk_tables()) {
    Method method;
    method.begins_anew = true;
    method.name = "erk:" + table.name;
    method.description = fmt::format("explicit Runge-Kutta, {} stages, order {}", table.stages, table.order);
    if (table.embedded_order > 0) method.description += fmt::format("({})", table.embedded_order);
    method.description += "; " + source;
    method.order = table.order;
    method.evaluations_per_step = effective_stages(table);
    method.adaptive = !table.b_embedded.empty();
    method.amplification = amplification_of(table);
    method.oscillator_step = oscillator_step_of(table);
    methods.push_back(std::move(method));
  }
  return methods;
}

std::unique_ptr<Stepper> make_erk(const IntegratorOptions& options, RelaxationSystem& system) {
  return std::make_unique<Erk>(options, system);
}

}  // namespace stillpoint
