// Whether a run stands still: a body that is drawn out or crushed without end stiffens without end, its stable step
// goes to nothing, and all the steps that are left would take it nowhere.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <string>

#include "simulation/phase_motion.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

class Standstill {
 public:
  static constexpr int patience = 30'000;          // steps, in which a body that is crushed turns inside out by name
  static constexpr double next_to_nothing = 1e-6;  // of a full step: a body stiffened by 1e12

  /// full_step: the longest that a step may be at the start [s].
  explicit Standstill(double full_step) : full_step_(full_step) {}

  /// After each step [s]. is_cut: it is as short as it is to end at a time that was asked for.
  void observe(double h, bool is_cut) {
    short_steps_ = !is_cut && h < next_to_nothing * full_step_ ? short_steps_ + 1 : 0;
  }
  /// For so many steps that it will not be over.
  bool lasts() const { return short_steps_ >= patience; }
  /// "time stands still: …, in a body that …", of a motion at t.
  std::string description(const LagrangianPhase& phase, PhaseMotion& motion, double t) const;

  void archive(const StateArchive& state) { state("short_steps", short_steps_); }

 private:
  double full_step_;
  int short_steps_ = 0;
};

}  // namespace stillpoint
