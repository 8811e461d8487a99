// From one stage of a run to the next: the phase ends, and a model is made anew of what its points hand on.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "plan/catalogue.hpp"
#include "scene/resolve.hpp"
#include "scene/stages.hpp"
#include "simulation/simulation_impl.hpp"

namespace stillpoint {
namespace {

Scene scene_of_next_stage(const Scene& now) {
  Scene next = now;
  begin_next_stage(next);
  resolve(next, catalogue());  // it was found in order before the run
  return next;
}

}  // namespace

// A static solver has no time, and comes to the next stage by an equilibrium alone.
bool Simulation::Impl::stage_is_over() const {
  const Scene& scene = run_->scene;
  if (scene.stages.empty()) return false;
  if (run_->model.static_method) return stage_verdict_.ends();
  const bool waits = scene.present_stage && scene.present_stage->equilibrium && run_->options.stops;
  return run_->t >= scene.stages.front().at && (!waits || stage_verdict_.ends());
}

// What doubts the equilibrium of a run doubts that of a stage.
StageFigures Simulation::Impl::figures_of_stage() {
  if (stage_verdict_.status == RunStatus::equilibrium)
    for (const Watched& watched : watchers_) watched.watcher->confirm(*run_, stage_verdict_);
  return {.begin = run_->stage.t,
          .end = run_->t,
          .status = stage_verdict_.ends() ? stage_verdict_.status : RunStatus::end_time,
          .reason = stage_verdict_.ends() ? stage_verdict_.reason : "the next stage began",
          .residual = run_->measured.residual(),
          .steps = run_->steps()};
}

void Simulation::Impl::next_stage() {
  stages_.push_back(figures_of_stage());
  record(true);
  end_phase();
  try {
    StageBegin next{.t = std::max(run_->t, run_->scene.stages.front().at),
                    .number = run_->stage.number + 1,
                    .carried = run_->model.phase->hand_over(run_->t, run_->motion->u(), run_->velocity_to_hand_on())};
    SavedState records;
    if (recorder_) recorder_->end_stage(StateArchive::saving(records));
    const double work = recorder_ ? recorder_->external_work() : 0;
    begin_stage(std::move(next));
    if (recorder_) recorder_->go_on(StateArchive::restoring(records), *run_, work);
    tell_phase_change(/*begun=*/true);
  } catch (const PointLost& lost) {
    end_with(lost);
  } catch (const SetUpStopped& stopped) {
    verdict_ = {stopped.status(), stopped.what()};
    is_readable_ = false;
  } catch (const SceneError& error) {
    end_between_phases(fmt::format("stage {}", run_->stage.number + 2), run_->scene.located(error).what());
  }
  let_watchers_begin();
}

// The records go on in files that are there; watchers look at each stage by itself, but for what it leaves for good.
void Simulation::Impl::begin_stage(StageBegin begins) {
  auto next = std::make_unique<RunState>(*run_, scene_of_next_stage(run_->scene), std::move(begins));
  const bool has_records = recorder_.has_value();
  SavedState seen;
  for (const auto& [name, watcher] : watchers_) watcher->archive_for_next_stage(StateArchive::saving(seen).part(name));
  recorder_.reset();
  watchers_.clear();
  run_ = std::move(next);
  stage_verdict_ = {};
  watchers_ = make_watchers(*run_);
  for (const auto& [name, watcher] : watchers_)
    watcher->archive_for_next_stage(StateArchive::restoring(seen).part(name));
  run_->begin_phase(run_->model.u, run_->model.v);
  if (has_records) recorder_.emplace(*run_, /*resumed=*/true);
}

void Simulation::Impl::archive_stages(const StateArchive& state) {
  int ended = run_->stage.number;
  std::vector<double> figures;
  std::vector<std::string> reasons;
  for (const StageFigures& one : stages_) {
    figures.insert(figures.end(),
                   {one.begin, one.end, static_cast<double>(one.status), one.residual, static_cast<double>(one.steps)});
    reasons.push_back(one.reason);
  }
  double begin = run_->stage.t;
  Verdict now = stage_verdict_;
  state("stage", ended, "stage_begin", begin, "stage_status", now.status, "stage_reason", now.reason);
  state("stage_figures", figures, "stage_reasons", reasons);
  if (!state.restores()) {
    if (ended > 0) run_->stage.carried->archive(state.part("carried"));
    return;
  }
  constexpr std::size_t row = 5;
  if (ended < 0 || static_cast<std::size_t>(ended) > run_->scene.stages.size() ||
      reasons.size() != static_cast<std::size_t>(ended) || figures.size() != row * reasons.size())
    throw StateError("it has other stages than the scene");
  stages_.clear();
  for (std::size_t k = 0; k < reasons.size(); ++k) {
    const double* const of = figures.data() + row * k;
    stages_.push_back({.begin = of[0],
                       .end = of[1],
                       .status = static_cast<RunStatus>(of[2]),
                       .reason = reasons[k],
                       .residual = of[3],
                       .steps = static_cast<long>(of[4])});
  }
  if (ended > 0) {
    auto carried = make_carried_body(run_->scene);
    carried->archive(state.part("carried"));
    // Stages before the last one only change the scene.
    for (int k = 1; k < ended; ++k) run_->scene = scene_of_next_stage(run_->scene);
    begin_stage({.t = begin, .number = ended, .carried = std::move(carried)});
  }
  stage_verdict_ = now;
}

}  // namespace stillpoint
