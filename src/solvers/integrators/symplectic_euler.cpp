// Symplectic Euler:  M (v_{n+1} − v_n)/h = Q_n + D(v_n, Q_n) − C v,   u_{n+1} = u_n + h v_{n+1},
//
// with C v_n (lagged), C v_{n+1} (implicit, the default), or v' = M⁻¹(Q_n − C v) solved exactly over the step
// (e^{−ch}). Q_{n+1} is evaluated at the end of a step, so that a state that cannot be evaluated is never accepted: one
// force evaluation a step, and one at the start. D(v_{n+1}, Q_{n+1}) is added there, where Q_n is still the last force.

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/parallel_loop.hpp"
#include "solvers/integrators/damped_acceleration.hpp"
#include "solvers/integrators/integrator_families.hpp"
#include "solvers/integrators/kick_drift.hpp"
#include "solvers/integrators/march.hpp"

namespace stillpoint {
namespace {

DampingTreatment treatment_of_symplectic_euler(DampingTreatment treatment) {
  if (treatment == DampingTreatment::automatic) return DampingTreatment::implicit;
  if (treatment != DampingTreatment::averaged) return treatment;
  throw std::invalid_argument("symplectic-euler treats damping 'implicit', 'lagged' or 'exact'");
}

class SymplecticEuler final : public March {
 public:
  SymplecticEuler(const IntegratorOptions& options, RelaxationSystem& system)
      : March(options, system),
        kick_drift_(system),
        acceleration_(treatment_of_symplectic_euler(options.treatment), system.damping().linear(),
                      kick_drift_.mass_of_kick()),
        Q_(system.vectors().make(system.size())),
        next_Q_(system.vectors().make(system.size())),
        a_(system.vectors().make(system.size())) {}

  // A step ends with the force at its end, unless the step was refused.
  Known known() const override { return kick_drift_.known(is_at_state()); }

 private:
  bool begin(double t, const Vector& y) override {
    if (!evaluate(t, y.span(), Q_.span())) return false;
    begin_velocity(y);
    return true;
  }
  bool restart(double t, const Vector& y) override {
    system().last_out_of_balance(t, Q_.span());
    system().add_local_damping(second_half(y.span()), Q_.span());
    begin_velocity(y);
    return true;
  }
  void begin_velocity(const Vector& y) {
    if (VelocityOfMomentum* const of = kick_drift_.velocity()) of->begin(second_half(y.span()), Q_.span());
  }

  Attempt attempt(double t, Vector& y, double h, double /*t_stop*/, Vector& trial) override {
    const ConstVec u = first_half(std::as_const(y).span()), v = second_half(std::as_const(y).span());
    const Vec u_new = first_half(trial.span()), v_new = second_half(trial.span()), a = a_.span();

    std::ranges::copy(std::as_const(Q_).span(), a.begin());
    acceleration_(h, v, a);
    VelocityOfMomentum* const of = kick_drift_.velocity();
    if (of) {
      std::ranges::copy(std::as_const(of->b).span(), of->a.span().begin());
      acceleration_(h, of->v.span(), of->a.span());
    }
    kick_drift_(h, a, h, u, v, u_new, v_new);
    if (!evaluate(t + h, trial.span(), next_Q_.span())) return {.status = StepReport::Status::inadmissible, .h = h};
    if (of) of->take_force(next_Q_.span());
    return {.h = h};
  }

  // Evaluates Q + D(v, Q) into Q.
  bool evaluate(double t, ConstVec y, Vec Q) {
    return system().damped_out_of_balance(t, first_half(y), second_half(y), Q);
  }

  void accepted() override {
    std::swap(Q_, next_Q_);
    kick_drift_.accept();
  }

  void archive_memory(const StateArchive& state) override {
    state("Q", Q_.span());
    kick_drift_.archive(state);
  }

  KickDrift kick_drift_;
  DampedAcceleration acceleration_;
  Vector Q_, next_Q_;  // Q + D at t_n and at the trial's time, (n)
  Vector a_;           // (n)
};

}  // namespace

Method symplectic_euler_method(DampingTreatment treatment) {
  const DampingTreatment used = treatment_of_symplectic_euler(treatment);
  Method method;
  method.name = "symplectic-euler";
  method.description = "semi-implicit Euler; damping implicit (default), lagged or exact";
  method.treatments = {DampingTreatment::automatic, DampingTreatment::lagged, DampingTreatment::implicit,
                       DampingTreatment::exact};
  method.remembers_force = true;
  method.order = 1;
  method.evaluations_per_step = 1;
  method.amplification = kick_drift_amplification(used);
  return method;
}

std::unique_ptr<Stepper> make_symplectic_euler(const IntegratorOptions& options, RelaxationSystem& system) {
  return std::make_unique<SymplecticEuler>(options, system);
}

}  // namespace stillpoint
