// Leapfrog, the central differences of the finite element and discrete element codes:
//
//   M (v⁺ − v⁻)/h + C (v⁻ + v⁺)/2 = Q_n,   u_{n+1} = u_n + h v⁺,   v⁻ at t_n − h/2, v⁺ at t_n + h/2,
//
// with C v⁻ in place of the mean if the damping is lagged. It is implemented in its synchronised form, with
// v_n = (v⁻ + v⁺)/2 known at every t_n, so that the step may change between calls:
//
//   v⁺ = v_n + h/2 a_n                                kick
//   u_{n+1} = u_n + h v⁺                              drift
//   M a_{n+1} = Q_{n+1} + D(v⁺, Q_{n+1}) − C (v⁺ + h/2 a_{n+1})     [lagged: − C v⁺]
//   v_{n+1} = v⁺ + h/2 a_{n+1}                        kick
//
// Local damping D sees the half-step velocity, as in FLAC. A step costs one force evaluation; the start costs one more.

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/parallel_loop.hpp"
#include "solvers/integrators/damped_acceleration.hpp"
#include "solvers/integrators/integrator_families.hpp"
#include "solvers/integrators/kick_drift.hpp"
#include "solvers/integrators/march.hpp"

namespace stillpoint {
namespace {

DampingTreatment treatment_of_leapfrog(DampingTreatment treatment) {
  if (treatment == DampingTreatment::automatic) return DampingTreatment::averaged;
  if (treatment == DampingTreatment::averaged || treatment == DampingTreatment::lagged) return treatment;
  throw std::invalid_argument("leapfrog treats damping 'averaged' or 'lagged'");
}

class Leapfrog final : public March {
 public:
  Leapfrog(const IntegratorOptions& options, RelaxationSystem& system)
      : March(options, system),
        kick_drift_(system),
        initial_acceleration_(DampingTreatment::lagged, system.damping().linear(), kick_drift_.mass_of_kick()),
        acceleration_(treatment_of_leapfrog(options.treatment), system.damping().linear(), kick_drift_.mass_of_kick()),
        a_(system.vectors().make(system.size())),
        next_a_(system.vectors().make(system.size())) {}

  // A step ends with the force at its end, unless the step was refused.
  Known known() const override { return kick_drift_.known(is_at_state()); }

 private:
  // M a_0 = Q_0 + D(v_0, Q_0) − C v_0
  bool begin(double t, const Vector& y) override {
    const ConstVec v = second_half(y.span());
    if (!system().damped_out_of_balance(t, first_half(y.span()), v, a_.span())) return false;
    begin_acceleration(v);
    return true;
  }

  bool restart(double t, const Vector& y) override {
    system().last_out_of_balance(t, a_.span());
    const ConstVec v = second_half(y.span());
    system().add_local_damping(v, a_.span());
    begin_acceleration(v);
    return true;
  }

  // Replaces Q_0 + D by a_0.
  void begin_acceleration(ConstVec v) {
    if (VelocityOfMomentum* const of = kick_drift_.velocity()) {
      of->begin(v, a_.span());
      initial_acceleration_(0, of->v.span(), of->a.span());
    }
    initial_acceleration_(0, v, a_.span());
  }

  Attempt attempt(double t, Vector& y, double h, double /*t_stop*/, Vector& trial) override {
    const ConstVec u = first_half(std::as_const(y).span()), v = second_half(std::as_const(y).span()), a = a_.span();
    const Vec u_new = first_half(trial.span()), v_new = second_half(trial.span()), a_new = next_a_.span();

    kick_drift_(h / 2, a, h, u, v, u_new, v_new);
    if (!system().damped_out_of_balance(t + h, u_new, v_new, a_new))
      return {.status = StepReport::Status::inadmissible, .h = h};
    std::atomic<bool> finite = true;
    const auto kick = [&](Vec velocity, Vec acceleration) {
      acceleration_(h, velocity, acceleration, [&](std::size_t begin, std::size_t count) {
        const double *a_piece = acceleration.data() + begin, *u_piece = u_new.data() + begin;
        double *v_piece = velocity.data() + begin, squares = 0;
#pragma omp simd reduction(+ : squares)
        for (std::size_t i = 0; i < count; ++i) {
          v_piece[i] += h / 2 * a_piece[i];
          squares += v_piece[i] * v_piece[i] + u_piece[i] * u_piece[i];
        }
        if (!std::isfinite(squares)) finite = false;
      });
    };
    if (VelocityOfMomentum* const of = kick_drift_.velocity()) {
      of->take_force(a_new);
      kick(of->next_v.span(), of->next_a.span());
    }
    kick(v_new, a_new);
    return {.h = h, .is_finite = finite};
  }

  void accepted() override {
    std::swap(a_, next_a_);
    kick_drift_.accept();
  }

  void archive_memory(const StateArchive& state) override {
    state("a", a_.span());
    kick_drift_.archive(state);
  }

  KickDrift kick_drift_;
  DampedAcceleration initial_acceleration_, acceleration_;
  Vector a_, next_a_;  // at t_n and at the trial's time, (n)
};

}  // namespace

Method leapfrog_method(DampingTreatment treatment) {
  const DampingTreatment used = treatment_of_leapfrog(treatment);
  Method method;
  method.name = "leapfrog";
  method.description =
      "central differences, synchronised; damping averaged (default) or lagged (first order where damped)";
  method.treatments = {DampingTreatment::automatic, DampingTreatment::averaged, DampingTreatment::lagged};
  method.remembers_force = method.hosts_relaxations = true;
  method.order = 2;
  method.evaluations_per_step = 1;
  method.amplification = kick_drift_amplification(used);
  return method;
}

std::unique_ptr<Stepper> make_leapfrog(const IntegratorOptions& options, RelaxationSystem& system) {
  return std::make_unique<Leapfrog>(options, system);
}

}  // namespace stillpoint
