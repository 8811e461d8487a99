// One simulation: its parts, and the state of its loop.
#pragma once

#include <stillpoint/simulation.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/stopwatch.hpp"
#include "output/folder_lock.hpp"
#include "plan/matrix_size.hpp"
#include "simulation/advice/mechanism.hpp"
#include "simulation/chatter.hpp"
#include "simulation/creep.hpp"
#include "simulation/end_request.hpp"
#include "simulation/equilibrium_stability.hpp"
#include "simulation/error_bound.hpp"
#include "simulation/failure.hpp"
#include "simulation/giving_way.hpp"
#include "simulation/limit_load.hpp"
#include "simulation/loads/load_schedule.hpp"
#include "simulation/monitor.hpp"
#include "simulation/phase_motion.hpp"
#include "simulation/plastic_path.hpp"
#include "simulation/rate_share.hpp"
#include "simulation/recorder.hpp"
#include "simulation/setup/model.hpp"
#include "simulation/standstill.hpp"
#include "simulation/thread_choice.hpp"

namespace stillpoint {

class Simulation::Impl {
 public:
  /// threads: that there are.
  Impl(Scene scene, SimulationOptions options, int threads);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RunStatus step(double t_stop);
  bool done() const { return status_ != RunStatus::running; }
  /// By itself it costs far less than all of measure(): a comparison asks for it after many steps.
  double residual() {
    if (!measured_ && !std::exchange(has_residual_, true)) residual_ = motion_->residual(t_);
    return residual_;
  }
  std::optional<double> distance() {
    measure();
    return distance_beside_creep();
  }
  ConstVec field(std::string_view name);
  int exit_status() const;
  Summary summary();                           // simulation_summary.cpp
  void save(const std::filesystem::path& to);  // simulation_state.cpp
  Moment now() const { return {t_, steps(), phases_}; }
  long steps() const { return earlier_steps_ + motion_->integrator->steps(); }
  /// All that acts on the body, walls that are still on their way included.
  bool loads_settled() const;
  long evaluations() const { return earlier_evaluations_ + motion_->system.evaluations(); }

  Scene scene_;
  SimulationOptions options_;
  EndRequest end_request_;
  Stopwatch wall_;
  VectorSpace vectors_;
  Model model_;
  Monitor monitor_;
  ErrorBound error_bound_;
  LoadSchedule schedule_;
  Chatter chatter_;
  PlasticPath plastic_path_;
  RateShare rate_share_;
  GivingWay giving_way_;
  Creep creep_;
  Standstill standstill_;
  ThreadChoice thread_choice_;
  LimitLoad limit_load_{scene_.stop.load_growth};
  MechanismWatch mechanism_{scene_.stop.wants_equilibrium() && !model_.omega_1 &&
                            matrix_size(scene_, body_size(scene_)).factor_fits(memory_room())};
  std::shared_ptr<FolderLock> folder_lock_;  // until the run is over
  std::optional<Recorder> recorder_;

  std::optional<PhaseMotion> motion_;  // of the present phase
  int phases_ = 1;
  double t_, step_ = 0;
  RunStatus status_ = RunStatus::running;
  std::string reason_;

 private:
  Model set_up();
  std::function<bool()> asks_to_end();
  void begin_phase(ConstVec u0, ConstVec v0);
  void take_step(double t_stop);
  std::optional<StepReport> try_step(double landing);
  double landing_time(double t_stop) const;
  void next_phase();
  ConstVec velocity_to_carry();
  bool try_next_phase();
  void tell_phase_change(bool begun) const;

  bool watches_chatter() const;
  void watch_chatter(double share, double residual);
  void watch_plastic_path();
  void watch_creep();
  void look_for_mechanism();
  void look_for_standstill();
  void look_for_limit_load();
  void watch();
  void look_for_end();
  bool iterate_is_balanced();
  bool creeps() const;
  void follow_period();

  void measure();
  bool has_distance() const {
    return model_.learns_omega_1 || (model_.omega_1 && !model_.phase->info().updated_lagrangian);
  }
  std::optional<double> distance_to_go() const;
  std::optional<double> distance_beside_creep() const;
  bool is_bound() const;
  void refresh_distance();
  void refresh_distance_in_time();

  bool leaves_checkpoints() const { return recorder_ && !options_.out.empty() && scene_.checkpoint.wanted(); }
  bool checkpoint_is_due();
  void leave_checkpoint();
  bool is_to_end();
  void end_as_asked(const std::string& where);
  void archive(const StateArchive& state);
  void archive_motion(const StateArchive& state);
  void resume(const std::filesystem::path& from);

  void sample(bool last);
  void report_progress();
  void say_what_moves();
  void say_how_far_one_phase_went();
  void say_what_phases_left();
  void test_stability();
  void finish();

  void fill_effort(Summary& s) const;
  void fill_model(Summary& s) const;
  void fill_state(Summary& s);

  long earlier_steps_ = 0, earlier_evaluations_ = 0, earlier_rejected_ = 0;  // of the phases before
  bool started_ = false;
  bool is_readable_ = true;    // false if the points are between two phases, because the second could not begin
  bool measured_ = false;      // whether the next five are of now
  bool has_residual_ = false;  // whether the first of them is
  double residual_ = 0, kinetic_energy_ = 0, work_scale_ = 0, power_ = 0;
  std::optional<double> distance_;
  EquilibriumStability stability_;
  double stepping_s_ = 0, earlier_wall_s_ = 0, next_progress_ = 0;
  long last_checkpoint_ = 0;      // [steps]
  double next_checkpoint_s_ = 0;  // on wall_
  std::vector<double> field_;
};

}  // namespace stillpoint
