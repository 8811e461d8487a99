#include "simulation/run_state.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "base/stop_request.hpp"
#include "parallel/of_all.hpp"
#include "simulation/later_ground.hpp"
#include "simulation/other_run.hpp"
#include "simulation/setup/model.hpp"
#include "simulation/setup/ranks_refusal.hpp"

namespace stillpoint {
namespace {

// The checksum of the body as it was placed; a file of points may have changed since.
std::int64_t checksum_of_body(const LagrangianPhase& phase) {
  const PointData points = phase.fields().point_data();
  std::uint64_t sum = 0;
  for (const auto* values : {&points.initial_positions, &points.masses})
    sum = checksum(sum, values->data(), values->size() * sizeof(double));
  return static_cast<std::int64_t>(sum);
}

}  // namespace

RunState::RunState(Scene of, SimulationOptions with)
    : scene(std::move(of)),
      options(std::move(with)),
      end_request(scene.stop.wall_time, options.interrupted),
      model(set_up()),
      schedule(scene, *model.phase, scene.stop.time),
      giving_way(scene, *model.phase),
      measured(*this, model),
      t(model.t) {}

RunState::RunState(RunState& before, Scene of, StageBegin begins)
    : scene(std::move(of)),
      options(before.options),
      end_request(before.end_request),
      wall(before.wall),
      stage(std::move(begins)),
      model(set_up()),
      schedule(scene, *model.phase, scene.stop.time),
      giving_way(scene, *model.phase),
      measured(*this, model),
      t(model.t),
      phases(before.phases + 1),
      first_phase(phases),
      earlier_steps(before.steps()),
      earlier_evaluations(before.evaluations()),
      earlier_rejected(before.rejected_steps()),
      stepping_s(before.stepping_s),
      earlier_wall_s(before.earlier_wall_s) {
  std::vector<std::string> notes = before.model.notes;
  for (std::string& note : model.notes)
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
  model.notes = std::move(notes);
}

Model RunState::set_up() {
  const StopScope scope(stage.number == 0 ? asks_this_rank_to_end() : asks_to_end());
  try {
    heed_stop_request();
    if (options.ranks) refuse_what_ranks_lack(scene);
    if (stage.number == 0 && !scene.stages.empty()) check_ground_of_later_stages(scene);
    std::vector<std::string> notes;
    if (!scene.initial_from.empty() && !stage.carried) stage.carried = points_of_other_run(scene, notes);
    Model made = make_model(scene, require_memory(make_plan(scene)), stage.carried ? nullptr : options.store,
                            {.carried = stage.carried.get(), .t = stage.t, .ranks = options.ranks.get()});
    if (!scene.initial_from.empty() && stage.number == 0) refuse_sparse_points(scene, *made.phase);
    made.notes.insert(made.notes.begin(), notes.begin(), notes.end());
    return made;
  } catch (const Stopped&) {
    throw SetUpStopped(end_request.status(), end_request.reason() + " in the set-up; the run has not begun",
                       wall.seconds());
  }
}

void RunState::begin_next_phase(ConstVec v0) {
  earlier_steps = steps();
  earlier_evaluations = evaluations();
  earlier_rejected = rejected_steps();
  model.relaxing.from = motion->stepper->carried_over();
  motion.reset();
  begin_phase(std::vector<double>(v0.size(), 0.0), v0);
}

std::vector<double> RunState::velocity_to_hand_on() const {
  if (model.multigrid) return std::vector<double>(model.phase->size(), 0.0);
  return {motion->v().begin(), motion->v().end()};
}

// A static solver finds the equilibrium of a stage under the loads of the time at which the next one begins.
bool RunState::loads_stay() const {
  const double ramp = scene.present_stage && stage.carried ? scene.present_stage->ramp.value() : 0;
  return (schedule.settled(t) || (model.static_method && !scene.stages.empty())) && t >= stage.t + ramp;
}

bool RunState::loads_settled() const {
  const Contact* const contact = model.phase->contact();
  return loads_stay() && (!contact || contact->is_settled()) && contact_settled;
}

void RunState::check_that_ranks_agree() const {
  if (!options.ranks || !motion) return;
  std::uint64_t sum = 0;
  for (const ConstVec values : {motion->u(), motion->v()})
    sum = checksum(sum, values.data(), values.size() * sizeof(double));
  const std::vector<std::uint64_t> sums = of_all(options.ranks.get(), sum);
  if (std::ranges::any_of(sums, [sum](std::uint64_t other) { return other != sum; }))
    throw std::runtime_error(
        failed("the ranks have come apart, as their processors do not compute alike; expected machines of one kind")
            .reason);
}

Verdict RunState::failed(const std::string& what) const {
  return {RunStatus::failed, fmt::format("at t = {:.6g} s, after {} steps, in phase {}: {}", t, steps(), phases, what)};
}

// Ranks come to an end together: between two steps, or where they hear of a wish at the same place.
std::function<bool()> RunState::asks_to_end() { return options.ranks ? nullptr : asks_all_to_end(); }

// Before a run has begun there is nothing that ranks would have to leave together.
std::function<bool()> RunState::asks_this_rank_to_end() {
  if (!options.stops) return {};
  return [this] { return end_request.asked(); };
}

std::function<bool()> RunState::asks_all_to_end() {
  if (!options.stops) return {};
  return [this] { return end_request.asked_of_any(options.ranks.get()); };
}

void RunState::archive(const StateArchive& state) {
  std::int64_t body = checksum_of_body(*model.phase);
  const std::int64_t placed = body;
  state("body", body);
  if (body != placed) throw StateError("it is of another body: its material points were placed elsewhere");

  state("t", t, "step", step, "phases", phases, "first_phase", first_phase, "steps_before", earlier_steps,
        "evaluations_before", earlier_evaluations, "rejected_before", earlier_rejected);
  double before_s = wall_s();
  state("wall_s", before_s);
  if (state.restores()) earlier_wall_s = before_s;
  state("stepping_s", stepping_s);

  state("carried_last_step", model.relaxing.from.last_step, "carried_rate", model.relaxing.from.rate,
        "carried_step_share", model.relaxing.from.step_share);
  model.phase->control().archive(state.part("phase"));
  const StateArchive moving = state.part("motion");
  if (state.restores()) {  // the motion is made at the state that it is to have: another may not be one to evaluate
    std::vector<double> y(2 * model.phase->size());
    moving("y", Vec(y));
    motion.reset();
    if (phases > first_phase) follow_multigrid(scene, model);
    begin_phase(first_half(ConstVec(y)), second_half(ConstVec(y)));
  }
  motion->archive(moving);
  measured.archive(state);
}

}  // namespace stillpoint
