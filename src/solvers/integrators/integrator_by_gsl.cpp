#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "base/quiet_gsl.hpp"
#include "solvers/integrators/integrator_families.hpp"
#include "solvers/integrators/march.hpp"
#include "solvers/spectrum/two_by_two.hpp"

namespace stillpoint {
namespace {

using GslStep = std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)>;
using Driver = std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)>;

struct StepperInfo {
  const char* name;
  const gsl_odeiv2_step_type* type;
  int order;  // of the solution with which the stepper continues
  const char* description;
};

const std::array<StepperInfo, 6>& steppers() {
  static const std::array<StepperInfo, 6> all = {{
      {"gsl:rk2", gsl_odeiv2_step_rk2, 3, "GSL's explicit Runge-Kutta 2(3), going on with the third-order solution"},
      {"gsl:rk4", gsl_odeiv2_step_rk4, 4, "GSL's classical Runge-Kutta in two half steps, error by step doubling"},
      {"gsl:rkf45", gsl_odeiv2_step_rkf45, 5, "GSL's explicit Runge-Kutta-Fehlberg 4(5)"},
      {"gsl:rkck", gsl_odeiv2_step_rkck, 5, "GSL's explicit Runge-Kutta-Cash-Karp 4(5)"},
      {"gsl:rk8pd", gsl_odeiv2_step_rk8pd, 8, "GSL's explicit Runge-Kutta-Prince-Dormand 8(9)"},
      {"gsl:msadams", gsl_odeiv2_step_msadams, 0, "GSL's Adams multistep, order 1 to 12, adaptive only"},
  }};
  return all;
}

const gsl_odeiv2_step_type* stepper_named(const std::string& name) {
  for (const StepperInfo& stepper : steppers()) {
    if (name == stepper.name) return stepper.type;
  }
  throw std::invalid_argument("there is no method '" + name + "'");
}

GslStep make_stepper(const gsl_odeiv2_step_type* type, std::size_t size) {
  return {gsl_odeiv2_step_alloc(type, size), gsl_odeiv2_step_free};
}

// --- properties of a stepper, found by applying it: GSL does not publish its tableaux ---

/// Oscillators u'' + rate u' + omega² u = D, y = [u; v].
struct OscillatorEquations {
  double omega = 1, rate = 0;
  const Damping* local = nullptr;  // null: D = 0
  std::size_t count = 1;
  int evaluations = 0;

  static int right_hand_side(double /*t*/, const double y[], double ydot[], void* self) {
    auto& all = *static_cast<OscillatorEquations*>(self);
    ++all.evaluations;
    for (std::size_t u = 0, v = all.count; u < all.count; ++u, ++v) {
      ydot[u] = y[v];
      ydot[v] = -all.omega * all.omega * y[u] - all.rate * y[v];
    }
    if (all.local) all.local->add_local({y + all.count, all.count}, {ydot + all.count, all.count});
    return GSL_SUCCESS;
  }
};

// Takes one step of length h from y, in place, as the fixed-step integrator below takes it. y: (2 count).
void apply_once(const gsl_odeiv2_step_type* type, OscillatorEquations& oscillator, double h, Vec y) {
  const GslStep stepper = make_stepper(type, y.size());
  const gsl_odeiv2_system system = {OscillatorEquations::right_hand_side, nullptr, y.size(), &oscillator};
  std::vector<double> error(y.size()), ydot_in(y.size()), ydot_out(y.size());
  OscillatorEquations::right_hand_side(0, y.data(), ydot_in.data(), &oscillator);
  oscillator.evaluations = 0;  // the evaluation at the start belongs to the step before
  gsl_odeiv2_step_apply(stepper.get(), 0, h, y.data(), error.data(), ydot_in.data(), ydot_out.data(), &system);
}

int evaluations_of(const gsl_odeiv2_step_type* type) {
  OscillatorEquations oscillator;
  std::array<double, 2> y = {1, 0};
  apply_once(type, oscillator, 0.1, y);
  return oscillator.evaluations;
}

// The columns of the step's 2 × 2 map are its images of [1; 0] and [0; 1]. Time is measured in units of the
// oscillator's own, ω h in place of h, so that the two columns have entries of one size.
AmplificationRadius amplification_of(const gsl_odeiv2_step_type* type) {
  return [type](double h, double omega, double rate) {
    if (omega == 0) omega = 1, h = 0, rate = 0;
    OscillatorEquations oscillator{.omega = 1, .rate = rate / omega};
    std::array<double, 2> p = {1, 0}, q = {0, 1};
    apply_once(type, oscillator, h * omega, p);
    apply_once(type, oscillator, h * omega, q);
    return spectral_radius({.trace = p[0] + q[1], .determinant = p[0] * q[1] - p[1] * q[0]});
  };
}

// --- the integrator ---

class Gsl final : public March {
 public:
  Gsl(const IntegratorOptions& options, RelaxationSystem& system)
      : March(options, system),
        type_(stepper_named(options.method)),
        size_(2 * system.size()),
        equations_{right_hand_side, nullptr, size_, this},
        ydot_(adaptive() ? 0 : size_),
        next_ydot_(ydot_.size()),
        error_(ydot_.size()) {
    const QuietGsl quiet;
    if (adaptive()) {
      // error ≤ rtol |y| + 1 · atol, atol apart for u and v
      std::vector<double> atol(size_, options.atol_u);
      std::fill(atol.begin() + static_cast<std::ptrdiff_t>(system.size()), atol.end(), options.atol_v);
      driver_.reset(gsl_odeiv2_driver_alloc_scaled_new(&equations_, type_, options.max_step, 1, *options.rtol, 1, 0,
                                                       atol.data()));
    } else {
      stepper_ = make_stepper(type_, size_);
    }
    if (!driver_ && !stepper_) throw std::runtime_error("GSL cannot make the stepper of " + options.method);
  }
  Gsl(const Gsl&) = delete;
  Gsl& operator=(const Gsl&) = delete;

 private:
  bool begin(double t, const Vector& y) override {
    const QuietGsl quiet;
    suggested_h_ = options().max_step;
    if (adaptive()) {
      refused();
      return true;
    }
    gsl_odeiv2_step_reset(stepper_.get());
    const bool is_admissible = right_hand_side(t, y.span().data(), ydot_.data(), this) == GSL_SUCCESS;
    rethrow();
    return is_admissible;
  }

  Attempt attempt(double t, Vector& y, double h, double t_stop, Vector& trial) override {
    const QuietGsl quiet;
    std::ranges::copy(std::as_const(y).span(), trial.span().begin());
    return adaptive() ? adaptive_step(t, h, t_stop, trial.span().data()) : fixed_step(t, h, trial.span().data());
  }

  Attempt fixed_step(double t, double h, double* y) {
    const int code =
        gsl_odeiv2_step_apply(stepper_.get(), t, h, y, error_.data(), ydot_.data(), next_ydot_.data(), &equations_);
    rethrow();
    return code == GSL_SUCCESS ? Attempt{.h = h} : failure(code, h);
  }

  Attempt adaptive_step(double t, double h, double t_stop, double* y) {
    suggested_h_ = std::min(suggested_h_, h);
    const unsigned long failed_before = driver_->e->failed_steps;
    double reached = t;
    const int code =
        gsl_odeiv2_evolve_apply(driver_->e, driver_->c, driver_->s, &equations_, &reached, t_stop, &suggested_h_, y);
    rethrow();
    count_rejected(static_cast<long>(driver_->e->failed_steps - failed_before));
    if (code != GSL_SUCCESS) {
      refused();
      return failure(code, std::min(h, t_stop - t));
    }
    return {.h = driver_->e->last_step, .t = reached};
  }

  void accepted() override { std::swap(ydot_, next_ydot_); }

  // The memory of a multistep method or of the step control belongs to a state that is given up.
  void refused() override {
    if (driver_) gsl_odeiv2_driver_reset(driver_.get());
  }

  Attempt failure(int code, double h) const {
    if (code == GSL_EBADFUNC) return {.status = StepReport::Status::inadmissible, .h = h};
    // The failure of the step control, which GSL calls no more than "failure".
    const std::string said = code == GSL_FAILURE
                                 ? "the step has shrunk to the rounding of t without meeting integrator.rtol and atol_*"
                                 : gsl_strerror(code);
    return {.status = StepReport::Status::failed, .h = h, .message = "GSL: " + said};
  }

  void rethrow() {
    if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
  }

  // y' = f(t, y) for C. GSL gives a step up at once on GSL_EBADFUNC; TrialStepper tries a smaller one.
  static int right_hand_side(double t, const double y[], double ydot[], void* self) noexcept {
    auto& gsl = *static_cast<Gsl*>(self);
    try {
      return gsl.system()(t, {y, gsl.size_}, {ydot, gsl.size_}) ? GSL_SUCCESS : GSL_EBADFUNC;
    } catch (...) {
      gsl.exception_ = std::current_exception();
      return GSL_EBADFUNC;
    }
  }

  const gsl_odeiv2_step_type* type_;
  std::size_t size_;  // 2n
  gsl_odeiv2_system equations_;
  std::vector<double> ydot_, next_ydot_, error_;    // (2n), fixed steps: f at the state and at the trial
  GslStep stepper_{nullptr, gsl_odeiv2_step_free};  // fixed steps
  Driver driver_{nullptr, gsl_odeiv2_driver_free};  // adaptive steps; holds stepper, control and evolution together
  double suggested_h_ = 0;                          // adaptive steps [s]
  std::exception_ptr exception_;
};

}  // namespace

std::vector<Method> gsl_methods() {
  const QuietGsl quiet;
  std::vector<Method> methods;
  for (const StepperInfo& stepper : steppers()) {
    Method method;
    method.begins_anew = true;
    method.name = stepper.name;
    method.description = stepper.description;
    method.adaptive = true;
    method.fixed_step = stepper.type != gsl_odeiv2_step_msadams;
    if (method.fixed_step) {
      method.order = stepper.order;
      method.evaluations_per_step = evaluations_of(stepper.type);
      method.amplification = amplification_of(stepper.type);
      method.oscillator_step = [type = stepper.type](double h, const Damping& local, Oscillators& all) {
        OscillatorEquations equations{.local = &local, .count = all.u.size()};
        std::vector<double> y = all.u;
        y.insert(y.end(), all.v.begin(), all.v.end());
        apply_once(type, equations, h, y);
        const auto v = y.begin() + static_cast<std::ptrdiff_t>(all.u.size());
        all.u.assign(y.begin(), v);
        all.v.assign(v, y.end());
      };
    }
    methods.push_back(std::move(method));
  }
  return methods;
}

std::unique_ptr<Stepper> make_gsl(const IntegratorOptions& options, RelaxationSystem& system) {
  return std::make_unique<Gsl>(options, system);
}

}  // namespace stillpoint
