// The loop of a simulation: its steps and changes of phase, its watchers, its records and its end.
#pragma once

#include <stillpoint/simulation.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/run_folder.hpp"
#include "simulation/recorder.hpp"
#include "simulation/run_state.hpp"
#include "simulation/thread_choice.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {

class Simulation::Impl {
 public:
  /// threads: the number of threads that there are.
  Impl(Scene scene, SimulationOptions options, int threads);
  ~Impl();

  RunStatus step(double t_stop);
  bool done() const { return verdict_.ends(); }
  ConstVec field(std::string_view name);
  Summary summary();                           // simulation_summary.cpp
  void save(const std::filesystem::path& to);  // simulation_state.cpp

  std::unique_ptr<RunState> run_;  // in the present stage
  Verdict verdict_;
  ThreadChoice thread_choice_;
  bool is_readable_ = true;  // false if the points are between two phases, because the second could not begin

 private:
  void take_step(double t_stop);
  /// What follows a step: it is judged and recorded, and a phase or a stage that is over ends.
  void end_step();
  std::optional<StepReport> try_step(double landing);
  double landing_time(double t_stop) const;
  void give_up(const StepReport& report);
  void observe();
  void go_on();
  void judge();
  void next_phase();
  /// Ends the phase, with its watchers and records.
  void end_phase();
  void end_with(const PointLost& lost);
  /// Ends the run as a phase or a stage cannot begin.
  void end_between_phases(const std::string& next, const std::string& why);
  void let_watchers_begin();
  void tell_phase_change(bool begun) const {
    if (run_->options.at_phase_change) run_->options.at_phase_change(begun);
  }
  // simulation_stages.cpp
  /// Whether the next stage begins now.
  bool stage_is_over() const;
  void next_stage();
  void begin_stage(StageBegin begins);
  StageFigures figures_of_stage();
  void archive_stages(const StateArchive& state);
  void record(bool last) {
    if (recorder_) recorder_->sample(*run_, last);
  }
  void report_progress();
  void end_if_asked();

  void end_as_asked(const std::string& where) { verdict_ = run_->end_request.verdict(where); }
  void finish();

  bool leaves_checkpoints() const { return recorder_ && !run_->options.out.empty() && run_->scene.checkpoint.wanted(); }
  bool checkpoint_is_due();
  void leave_checkpoint();
  void archive(const StateArchive& state);
  void archive_end(const StateArchive& state);
  void resume(const std::filesystem::path& from);

  int exit_status() const;
  void fill_state(Summary& s);

  std::vector<Watched> watchers_;
  std::vector<StageFigures> stages_;         // that have ended
  Verdict stage_verdict_;                    // that the present one is in equilibrium; by default: not so far
  std::shared_ptr<FolderLock> folder_lock_;  // until the run is over
  std::optional<Recorder> recorder_;
  bool started_ = false;
  bool is_judging_ = false;                             // the last step has still to be judged,
  std::size_t next_to_judge_ = 0;                       // by the watchers from this one on
  double next_progress_s_ = 0, next_checkpoint_s_ = 0;  // on the clock of the run [s]
  long last_checkpoint_ = 0;                            // [steps]
  std::vector<double> field_;
};

}  // namespace stillpoint
