// How much of what a driven body is felt to bear is damping and inertia.
//
// What supports, walls and loads do on a body goes into its material but for ∫ Q·v dt, the work of the out-of-balance
// force Q = F − R of the free unknowns, M a = Q + D: that is what damping takes, and what inertia does, also that which
// light nodes were given, whose kinetic energy is lost from phase to phase. By virtual work along the motion that
// drives the body
//
//   share = |∫ Q·v dt| / W,   W = Σ |∫ R_s·v_s dt|  of the supports and walls that move, and of driven loads,
//                                 + |∫ F·v dt|      of the loads, which drive what falls
//
// is the mean share of damping and inertia in what these feel. A pile that is pushed into clay at 0.1 m/s with a local
// damping of α = 0 to 0.7 does between 8 and 49 times s_u, and 8 without this share, whatever α.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/relaxation_system.hpp>

#include <optional>
#include <string>
#include <vector>

#include "simulation/phase_motion.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

class RateShare {
 public:
  /// Watches where is_driven(). The phase outlives it.
  RateShare(const Problem& problem, const LagrangianPhase& phase);

  /// Whether it wants a sample after so many steps: each one at first, every 64th later.
  bool due(long steps) const { return watches_ && steps >= next_; }
  /// After an accepted step to t.
  void sample(double t, long steps, PhaseMotion& motion);

  /// Empty: nothing is driven, or what drives did no work.
  std::optional<double> share() const;
  void archive(const StateArchive& state);

 private:
  double work_of_driving(double t, const RelaxationSystem& system) const;

  const LagrangianPhase& phase_;
  bool watches_ = false;
  long next_ = 1, samples_ = 0;
  double t_ = 0, power_ = 0, load_power_ = 0;  // of the last sample; Q·v and F·v [W]
  double unbalanced_ = 0;                      // ∫ Q·v dt [J]
  double driving_ = 0;                         // W but for the stroke of now [J]
  double of_stroke_ = 0, of_loads_ = 0;        // what that comes to so far, of what moves and of the loads [J]
  std::vector<double> Q_;                      // (n) [N]
};

/// What to say of it; empty: nothing.
std::string note_on_rate_share(std::optional<double> share, const Problem& problem);

}  // namespace stillpoint
