#include "simulation/phase_motion.hpp"

#include <algorithm>

#include "solvers/statics/static_methods.hpp"

namespace stillpoint {
namespace {

// A damping leaves the steps to the integrator; a relaxation replaces the step of leapfrog, and a static solver that of
// any integrator.
std::unique_ptr<Stepper> make_stepper(const Model& model, const Problem& problem, RelaxationSystem& system) {
  if (model.static_method) {
    constexpr double default_residual = 1e-10;  // if only the distance is asked for
    const double residual = problem.stop.residual > 0 ? problem.stop.residual : default_residual;
    return make_static_method({.name = model.static_method->name,
                               .max_step = model.integrator.max_step,
                               .tolerance = residual,
                               .load_steps = problem.solve.load_steps,
                               .closes_with_friction = problem.rubs()},
                              system);
  }
  if (model.relaxation && model.method.hosts_relaxations) return make_relaxation(model.relaxing, system);
  return make_integrator(model.integrator, system);
}

}  // namespace

PhaseMotion::PhaseMotion(Model& model, const Problem& problem, const VectorSpace& vectors, double t, ConstVec u0,
                         ConstVec v0)
    : system(*model.phase, *model.damping, vectors, model.multigrid ? &model.multigrid->mass : nullptr),
      norms(system),
      shared_y(std::make_shared<Vector>(vectors.make(2 * model.phase->size()))),
      y(*shared_y),
      u_vector(vectors.view(first_half(y.span()))),
      v_vector(vectors.view(second_half(y.span()))),
      stepper(make_stepper(model, problem, system)) {
  std::ranges::copy(u0, first_half(y.span()).begin());
  std::ranges::copy(v0, second_half(y.span()).begin());
  stepper->start(t, y);
  if (!model.initial_stiffening) return;
  stiffening_.emplace(*model.phase, model.phase->size(), model.integrator.max_step, *model.initial_stiffening);
  follow_stiffness(t);
}

ConstVec PhaseMotion::v() const {
  const ConstVec second = second_half(y.span());
  if (!system.keeps_momentum()) return second;
  if (const ConstVec known = stepper->known().velocity; !known.empty()) return known;
  velocity_.assign(second.size(), 0.0);
  if (stepper->moves()) system.mass().solve(second, velocity_);
  return velocity_;
}

StateNorms::Motion PhaseMotion::motion() {
  if (!stepper->moves()) return {.power = 0, .kinetic_energy = 0};
  return norms.motion(v_vector, stepper->known().velocity);
}

void PhaseMotion::accept(double t) {
  stepper->accept(t);
  if (stepper->moves()) follow_stiffness(t);
}

void PhaseMotion::archive(const StateArchive& state) {
  state("y", y.span());
  stepper->archive(state.part("integrator"));
  system.archive(state.part("system"));
  if (stiffening_) stiffening_->archive(state.part("stiffening"));
}

void PhaseMotion::follow_stiffness(double t) {
  if (stiffening_) stepper->set_max_step(stiffening_->longest(t, u(), v()));
}

}  // namespace stillpoint
