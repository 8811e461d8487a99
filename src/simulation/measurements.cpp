#include "simulation/measurements.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/run_state.hpp"

namespace stillpoint {

const Measurements::Figures& Measurements::all() {
  if (std::exchange(is_measured_, true)) return figures_;
  PhaseMotion& motion = *run_.motion;
  figures_.residual = motion.residual(run_.t);
  if (const auto omega_1 = run_.model.learns_omega_1 ? motion.stepper->lowest_frequency() : std::nullopt)
    error_bound_.learn(*omega_1);
  figures_.distance = error_bound_.distance(motion.norms, motion.u_vector, motion.stepper->known().acceleration);
  figures_.work_scale = motion.norms.work_scale(motion.u_vector) + work_in_a_step();
  const StateNorms::Motion measured = motion.motion();
  figures_.power = measured.power;
  figures_.kinetic_energy = measured.kinetic_energy;
  if (run_.schedule.settled_for_good(run_.t)) error_bound_.loads_have_settled(figures_.kinetic_energy);
  return figures_;
}

// What begins at rest, as a stage may that changes nothing, has moved by no way at all: beside its work every velocity
// would be large, that of rounding too. The loads alone would do ‖F‖²/(m ω_max²) at least on a body of the mass m in
// the time of a step.
double Measurements::work_in_a_step() const {
  const Model& model = run_.model;
  if (run_.motion->system.keeps_momentum() || !(model.omega_max > 0)) return 0;
  const double F = run_.motion->system.force_scale();
  return F * F / (model.mass.factor * model.phase->info().total_mass * model.omega_max * model.omega_max);
}

double Measurements::residual() {
  if (!is_measured_ && !std::exchange(has_residual_, true)) figures_.residual = run_.motion->residual(run_.t);
  return figures_.residual;
}

bool Measurements::has_distance() const {
  const Model& model = run_.model;
  return model.learns_omega_1 || (model.omega_1 && !model.phase->info().updated_lagrangian);
}

std::optional<double> Measurements::distance() const {
  const std::optional<double>& way = creeping.way_left;
  if (!way || !figures_.distance || *way <= creeping.allowed) return figures_.distance;
  return std::isfinite(*way) ? std::optional(std::max(*figures_.distance, *way)) : std::nullopt;
}

std::optional<double> Measurements::distance_to_go() const {
  return run_.scene.stop.distance > 0 ? figures_.distance : error_bound_.beside_largest();
}

void Measurements::refresh_distance() {
  PhaseMotion& motion = *run_.motion;
  if (!error_bound_.refresh(run_.t, motion.u(), figures_.residual)) return;
  motion.norms.residual(run_.t, motion.u());
  figures_.distance = error_bound_.distance(motion.norms, motion.u_vector, motion.stepper->known().acceleration);
}

void Measurements::archive(const StateArchive& state) {
  state("measured", is_measured_, "residual", figures_.residual, "kinetic_energy", figures_.kinetic_energy,
        "work_scale", figures_.work_scale, "power", figures_.power, "distance", figures_.distance);
  error_bound_.archive(state.part("error_bound"));
}

}  // namespace stillpoint
