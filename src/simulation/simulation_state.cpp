// The state of a simulation between two steps: saved to a checkpoint, and gone on from.
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "output/checkpoint_file.hpp"
#include "parallel/of_all.hpp"
#include "simulation/own_files.hpp"
#include "simulation/simulation_impl.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

// The version and the scene that a checkpoint belongs to.
struct Origin {
  std::string version = STILLPOINT_VERSION, file, text;
  std::vector<std::string> overrides;

  void archive(const StateArchive& state) {
    state("version", version, "file", file, "scene", text, "overrides", overrides);
  }
};

Origin origin_of(const Scene& scene) {
  return {.file = fs::absolute(scene.file).string(), .text = scene.text, .overrides = scene.overrides};
}

Origin origin_of(const SavedState& saved) {
  Origin origin;
  origin.archive(StateArchive::restoring(saved).part("origin"));
  if (origin.version != STILLPOINT_VERSION)
    throw StateError(fmt::format("it is of version {}, expected {}", origin.version, STILLPOINT_VERSION));
  return origin;
}

void require_same(const Origin& saved, const Origin& now) {
  if (saved.text != now.text) throw StateError(fmt::format("it is of another scene than {}", now.file));
  if (saved.overrides == now.overrides) return;
  const auto told = [](const Origin& origin) {
    return origin.overrides.empty() ? "without --set"
                                    : fmt::format("with --set {}", fmt::join(origin.overrides, " --set "));
  };
  throw StateError(fmt::format("it is of the scene {}, expected one {}", told(saved), told(now)));
}

template <class Restore>
auto restoring(const fs::path& checkpoint, const Restore& restore) {
  try {
    return restore(read_checkpoint(checkpoint));
  } catch (const StateError& error) {
    throw StateError(fmt::format("{}: {}", checkpoint.string(), error.what()));
  }
}

}  // namespace

Scene load_scene_of(const fs::path& checkpoint) {
  return restoring(checkpoint, [](const SavedState& saved) {
    const Origin origin = origin_of(saved);
    return load_scene(origin.file, origin.text, origin.overrides);
  });
}

void Simulation::Impl::save(const fs::path& to) {
  SavedState state;
  origin_of(run_->scene).archive(StateArchive::saving(state).part("origin"));
  archive(StateArchive::saving(state));
  if (leaves_files(run_->options)) write_checkpoint(to, state);
}

void Simulation::Impl::resume(const fs::path& from) {
  restoring(from, [this](const SavedState& saved) {
    require_same(origin_of(saved), origin_of(run_->scene));
    archive(StateArchive::restoring(saved));
    if (std::min({run_->steps(), run_->evaluations(), run_->earlier_rejected}) < 0)
      throw StateError("its counts are negative");
  });
  last_checkpoint_ = run_->steps();
  next_checkpoint_s_ = run_->wall.seconds() + run_->scene.checkpoint.every;
  if (!done()) return;
  // What a static solver commits at the end has been evaluated in the run that left it alone.
  if (!leaves_checkpoints()) run_->motion->norms.residual(run_->t, run_->motion->u());
  finish();
}

void Simulation::Impl::archive(const StateArchive& state) {
  archive_stages(state);
  run_->archive(state);
  state("started", started_, "is_judging", is_judging_, "next_to_judge", next_to_judge_);
  for (const auto& [name, watcher] : watchers_) watcher->archive(state.part(name), *run_);
  if (recorder_) recorder_->archive(state.part("records"));
  archive_end(state);
}

// A run that has come to an end of its own is over when it is resumed; one that was asked to end goes on.
void Simulation::Impl::archive_end(const StateArchive& state) {
  Verdict end = is_own_end(verdict_.status) ? verdict_ : Verdict{};
  state("status", end.status, "reason", end.reason);
  if (end.ends() && !is_own_end(end.status)) throw StateError("'status' is none of a run that is over");
  if (state.restores()) verdict_ = end;
}

// --- when a checkpoint is left ---

// A method that begins anew when it is restored does so at fixed steps without that as well, and is saved there: with
// checkpoints a run has the same bits whether it was resumed or not.
bool Simulation::Impl::checkpoint_is_due() {
  const CheckpointSpec& when = run_->scene.checkpoint;
  const long steps = run_->steps();
  if (run_->model.method.begins_anew && !run_->model.static_method) {
    constexpr long default_interval = 1000;  // [steps]
    if (steps % (when.every_steps > 0 ? when.every_steps : default_interval) != 0) return false;
    run_->motion->stepper->start(run_->t, run_->motion->y);
  }
  const bool has_come = when.every > 0 && run_->wall.seconds() >= next_checkpoint_s_;
  return (when.every_steps > 0 && steps - last_checkpoint_ >= when.every_steps) ||
         (when.every > 0 && is_so_for_any(run_->options.ranks.get(), has_come));
}

void Simulation::Impl::leave_checkpoint() {
  last_checkpoint_ = run_->steps();
  next_checkpoint_s_ = run_->wall.seconds() + run_->scene.checkpoint.every;
  save(run_->options.out / "checkpoint.h5");
}

}  // namespace stillpoint
