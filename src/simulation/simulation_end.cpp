// How a simulation ends: as it is asked to, wherever it is at, or by itself.
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "simulation/advice/notes.hpp"
#include "simulation/advice/viscosity.hpp"
#include "simulation/left_in_points.hpp"
#include "simulation/simulation_impl.hpp"
#include "simulation/single_phase.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"

namespace stillpoint {
namespace {

// Whether the points have fewer strains than the body has unknowns, so that K is singular.
bool has_too_few_points(const LagrangianPhase& phase) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  const std::size_t strains =
      dim * (dim + 1) / 2 + (phase.info().gradient_components > phase.dim() * phase.dim() ? 1 : 0);
  return phase.points() * strains < phase.size();
}

}  // namespace

// --- for good ---

// Others may take up the phase. What looks at it goes first.
Simulation::Impl::~Impl() {
  if (!options_.store) return;
  recorder_.reset();
  motion_.reset();
  options_.store->give_back(model_.mass, std::move(model_.phase));
}

// --- because it is asked to ---

std::function<bool()> Simulation::Impl::asks_to_end() {
  if (!options_.stops) return {};
  return [this] { return end_request_.asked(); };
}

Model Simulation::Impl::set_up() {
  const StopScope scope(asks_to_end());
  try {
    heed_stop_request();
    return make_model(scene_, require_memory(make_plan(scene_)), options_.store);
  } catch (const Stopped&) {
    throw SetUpStopped(end_request_.status(), end_request_.reason() + " in the set-up; the run has not begun",
                       wall_.seconds());
  }
}

// One of a static solver may take long: it is broken off, at the last equilibrium on its way.
std::optional<StepReport> Simulation::Impl::try_step(double landing) {
  const StopScope scope(model_.static_method ? asks_to_end() : nullptr);
  try {
    return motion_->integrator->step(landing);
  } catch (const Stopped&) {
    end_as_asked("the step was not finished");
    measured_ = has_residual_ = false;
    sample(true);
    if (leaves_checkpoints()) leave_checkpoint();
    return std::nullopt;
  }
}

// Where that takes long and there is no time left, the distance is not known.
void Simulation::Impl::refresh_distance_in_time() {
  const StopScope scope(model_.phase->size() > direct_solver_limit ? asks_to_end() : nullptr);
  try {
    refresh_distance();
  } catch (const Stopped&) {
    distance_.reset();
  }
}

// Whether the run ends here, though it could go on.
bool Simulation::Impl::is_to_end() {
  if (options_.stops && end_request_.asked()) end_as_asked("the step was finished");
  return done();
}

void Simulation::Impl::end_as_asked(const std::string& where) {
  status_ = end_request_.status();
  reason_ = end_request_.reason() + "; " + where;
}

// --- by itself ---

// An iterate is no motion, whose residual is small for a moment: it is looked at as soon as it may be the answer.
bool Simulation::Impl::iterate_is_balanced() {
  if (!motion_->integrator->static_iteration()) return false;
  return scene_.stop.residual <= 0 || motion_->known_residual(t_) <= scene_.stop.residual;
}

// Limits that came before equilibrium say no more than that.
void Simulation::Impl::say_what_moves() {
  const bool is_limit =
      status_ == RunStatus::end_time || status_ == RunStatus::step_limit || status_ == RunStatus::time_limit;
  if (!is_limit || exit_status() == 0) return;
  if (const std::string slides = creep_.description(t_, motion_->u()); !slides.empty() && !reason_.starts_with(slides))
    reason_ = fmt::format("{}; {}", slides, reason_);
  if (scene_.stop.wants_equilibrium()) {
    const std::string creeping = creep(scene_, *model_.phase);
    reason_ += "; " + (creeping.empty() ? furthest_from_rest(*motion_, t_) : creeping);
  }
  if (scene_.stop.load_growth > 0) reason_ += "; no limit load: " + limit_load_.description();
}

// A grid that is squeezed bears what its material may not: an equilibrium that goes some way is told so, one that goes
// as far as its own size is none.
void Simulation::Impl::say_how_far_one_phase_went() {
  if (status_ != RunStatus::equilibrium) return;
  const auto most = strain_in_single_phase(*model_.phase, t_, motion_->u());
  const std::string said = most ? note_on_single_phase(most->strain) : "";
  if (said.empty()) return;
  if (most->strain <= largest_single_phase_strain) {
    reason_ += "; but " + said;
    return;
  }
  status_ = RunStatus::step_limit;
  reason_ = fmt::format("no equilibrium: {}; {} is strained most; it ended with {}", said,
                        to_string(model_.phase->diagnosis().of_point(most->point)), reason_);
}

void Simulation::Impl::say_what_phases_left() {
  if (status_ != RunStatus::equilibrium || !model_.phase->info().updated_lagrangian) return;
  if (const std::string fault = fault_of_push(scene_, model_.phase->supports().wall_reactions(t_)); !fault.empty()) {
    status_ = RunStatus::step_limit;
    reason_ = fmt::format("no equilibrium: {}; it ended with {}", fault, reason_);
    return;
  }
  const double unfelt = model_.phase->fields().null_space_stress(t_, motion_->u());
  if (const auto note = null_space_note(scene_, *model_.phase, unfelt)) reason_ += "; but " + *note;
}

// What claims to be an equilibrium may be one that the least disturbance ends.
void Simulation::Impl::test_stability() {
  const bool writes = recorder_ && !options_.out.empty();
  if (writes) remove_mode(options_.out);
  if (status_ != RunStatus::equilibrium) return;
  try {
    const StopScope scope(asks_to_end());
    stability_ = stability_of(*model_.phase, t_, motion_->u(), residual_);
  } catch (const Stopped&) {
    const std::string reached = reason_;
    end_as_asked("before it was known whether the equilibrium is stable, after " + reached);
    if (leaves_checkpoints()) leave_checkpoint();
    return;
  }
  const bool neutral = stability_.kind == EquilibriumStability::Kind::neutral;
  // A body that was held and is no more has softened away: what is left of its error bound certifies nothing.
  const bool softened_away = neutral && has_distance() && !distance_to_go();
  if (neutral && !softened_away) model_.notes.push_back(description(stability_));
  // Linear ways to rest from u = 0 never enter a null space that the load does not drive.
  const bool is_local = !model_.static_method && model_.damping->is_local();
  const bool strays = is_local || (neutral && model_.phase->info().nonlinear);
  const bool has_hourglasses = hourglass_note(scene_).has_value();
  if (strays && !model_.phase->history_dependent() && (has_hourglasses || has_too_few_points(*model_.phase))) {
    status_ = RunStatus::step_limit;
    reason_ = fmt::format(
        "no equilibrium: with {} the grid moves in ways that strain no point{}, which nothing resists, and how far the "
        "body goes along them is by chance where strains are large or damping is local; expected {}; it ended with {}",
        has_hourglasses ? "one material point a cell" : "so few material points",
        has_hourglasses ? ", hourglass motions" : "",
        has_hourglasses ? "points_per_cell = 8" : "more material points per cell", reason_);
    return;
  }
  if (stability_.kind != EquilibriumStability::Kind::unstable && !softened_away) return;
  status_ = RunStatus::unstable_equilibrium;
  reason_ = fmt::format("{}; {}", reason_, description(stability_));
  if (writes) write_mode(stability_, *model_.phase, t_, motion_->u(), options_.out);
}

void Simulation::Impl::finish() {
  if (is_readable_) motion_->finish(t_);
  if (is_readable_ && plastic_path_.watches()) watch_plastic_path();
  if (is_readable_) say_what_moves();
  test_stability();
  if (is_readable_) say_how_far_one_phase_went();
  if (is_readable_) say_what_phases_left();
  if (recorder_) recorder_->finish(t_, is_readable_ ? &*motion_ : nullptr);
  folder_lock_.reset();
}

}  // namespace stillpoint
