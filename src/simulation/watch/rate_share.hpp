// The share of damping and inertia in what a driven body is felt to bear.
//
// The work of supports, walls and loads on a body goes into its material but for ∫ Q·v dt, the work of the
// out-of-balance force Q = F − R of the free unknowns, M a = Q + D: damping takes it, or inertia, that which light
// nodes were given included, whose kinetic energy is lost from phase to phase. By virtual work along the motion that
// drives the body
//
//   share = |∫ Q·v dt| / W,   W = Σ |∫ R_s·v_s dt|  of the supports and walls that move, and of driven loads,
//                                 + |∫ F·v dt|      of the loads, which drive what falls
//
// is the mean share of damping and inertia in what these feel. A pile that is pushed into clay at 0.1 m/s with a local
// damping of α = 0 to 0.7 does between 8 and 49 times s_u, and 8 without this share, whatever α.
#pragma once

#include <vector>

#include "simulation/watcher.hpp"

namespace stillpoint {

class RateShare : public Watcher {
 public:
  /// Watches if something drives the body. The run outlives this object.
  explicit RateShare(const RunState& run);

  /// Takes a sample at each step at first, at every 64th later.
  void observe(RunState& run) override {
    if (watches_ && run.steps() >= next_) sample(run.t, run.steps(), *run.motion);
  }
  void fill(Summary& summary, const RunState& run) override;
  void archive(const StateArchive& state, RunState& run) override;

 private:
  void sample(double t, long steps, PhaseMotion& motion);
  double work_of_driving(double t, const RelaxationSystem& system) const;

  const LagrangianPhase& phase_;
  bool watches_ = false;
  long next_ = 1, samples_ = 0;
  double t_ = 0, power_ = 0, load_power_ = 0;  // time, Q·v and F·v [W] at the last sample
  double unbalanced_ = 0;                      // ∫ Q·v dt [J]
  double driving_ = 0;                         // W but for the present stroke [J]
  double of_stroke_ = 0, of_loads_ = 0;        // work in that stroke so far, of what moves and of the loads [J]
  std::vector<double> Q_;                      // (n) [N]
};

}  // namespace stillpoint
