// The state of a simulation between two steps: saved to a checkpoint, and gone on from.
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/checksum.hpp"
#include "output/checkpoint_file.hpp"
#include "simulation/simulation_impl.hpp"

namespace stillpoint {
namespace {

namespace fs = std::filesystem;

// What a checkpoint is of.
struct Origin {
  std::string version = STILLPOINT_VERSION, file, text;
  std::vector<std::string> overrides;

  void archive(const StateArchive& state) {
    state("version", version);
    state("file", file);
    state("scene", text);
    std::size_t count = overrides.size();
    state("overrides", count);
    constexpr std::size_t most = 100'000;  // more than a command line has
    if (count > most) throw StateError(fmt::format("it has {} settings: it was altered", count));
    overrides.resize(count);
    for (std::size_t k = 0; k < count; ++k) state(fmt::format("override_{}", k), overrides[k]);
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

// Of the body as it was placed, which a file of points may have changed since.
std::int64_t checksum_of_body(const LagrangianPhase& phase) {
  const PointData points = phase.fields().point_data();
  std::uint64_t sum = 0;
  for (const auto* values : {&points.initial_positions, &points.masses})
    sum = checksum(sum, values->data(), values->size() * sizeof(double));
  return static_cast<std::int64_t>(sum);
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
  origin_of(scene_).archive(StateArchive::saving(state).part("origin"));
  archive(StateArchive::saving(state));
  write_checkpoint(to, state);
}

void Simulation::Impl::resume(const fs::path& from) {
  restoring(from, [this](const SavedState& saved) {
    require_same(origin_of(saved), origin_of(scene_));
    archive(StateArchive::restoring(saved));
    if (std::min({steps(), evaluations(), earlier_rejected_}) < 0) throw StateError("its counts are negative");
  });
  last_checkpoint_ = steps();
  next_checkpoint_s_ = wall_.seconds() + scene_.checkpoint.every;
}

void Simulation::Impl::archive(const StateArchive& state) {
  std::int64_t body = checksum_of_body(*model_.phase);
  const std::int64_t placed = body;
  state("body", body);
  if (body != placed) throw StateError("it is of another body: its material points were placed elsewhere");

  state("t", t_);
  state("step", step_);
  state("phases", phases_);
  state("steps_before", earlier_steps_);
  state("evaluations_before", earlier_evaluations_);
  state("rejected_before", earlier_rejected_);
  state("started", started_);
  double wall_s = earlier_wall_s_ + wall_.seconds();
  state("wall_s", wall_s);
  if (state.restores()) earlier_wall_s_ = wall_s;
  state("stepping_s", stepping_s_);

  state("carried_last_step", model_.relaxing.from.last_step);
  state("carried_rate", model_.relaxing.from.rate);
  state("carried_step_share", model_.relaxing.from.step_share);
  model_.phase->control().archive(state.part("phase"));
  archive_motion(state.part("motion"));

  state("measured", measured_);
  state("residual", residual_);
  state("kinetic_energy", kinetic_energy_);
  state("work_scale", work_scale_);
  state("power", power_);
  state("distance", distance_);
  monitor_.archive(state.part("monitor"));
  error_bound_.archive(state.part("error_bound"));
  chatter_.archive(state.part("chatter"), model_.phase->points() * static_cast<std::size_t>(model_.phase->dim()));
  plastic_path_.archive(state.part("plastic_path"));
  rate_share_.archive(state.part("rate_share"));
  creep_.archive(state.part("creep"));
  standstill_.archive(state.part("standstill"));
  mechanism_.archive(state.part("mechanism"));
  limit_load_.archive(state.part("limit_load"));
  if (recorder_) recorder_->archive(state.part("records"));
}

// A motion is made at the state that it is to have, since no other may be one that can be evaluated.
void Simulation::Impl::archive_motion(const StateArchive& state) {
  if (state.restores()) {
    std::vector<double> y(2 * model_.phase->size());
    state("y", Vec(y));
    motion_.reset();
    if (phases_ > 1) follow_multigrid(scene_, model_);
    motion_.emplace(model_, scene_, vectors_, t_, first_half(ConstVec(y)), second_half(ConstVec(y)));
  }
  motion_->archive(state);
}

// --- when one is left ---

// A method that begins anew when it is restored does so at fixed steps without that as well, and is saved there: with
// checkpoints a run has the same bits whether it was resumed or not.
bool Simulation::Impl::checkpoint_is_due() {
  const CheckpointSpec& when = scene_.checkpoint;
  if (model_.method.begins_anew && !model_.static_method) {
    constexpr long usual = 1000;
    if (steps() % (when.every_steps > 0 ? when.every_steps : usual) != 0) return false;
    motion_->integrator->velocity_changed();
  }
  return (when.every_steps > 0 && steps() - last_checkpoint_ >= when.every_steps) ||
         (when.every > 0 && wall_.seconds() >= next_checkpoint_s_);
}

void Simulation::Impl::leave_checkpoint() {
  last_checkpoint_ = steps();
  next_checkpoint_s_ = wall_.seconds() + scene_.checkpoint.every;
  save(options_.out / "checkpoint.h5");
}

}  // namespace stillpoint
