// The figures of the present state of a run. They are measured once a step at most, and only if somebody asks.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <optional>

#include "simulation/error_bound.hpp"
#include "simulation/setup/model.hpp"

namespace stillpoint {

struct RunState;

class Measurements {
 public:
  struct Figures {
    double residual = 0;             // ‖F − R‖/‖F‖
    double kinetic_energy = 0;       // [J]
    double work_scale = 0;           // |F·u| + |R·u|, and what loads do in a step [J]
    double power = 0;                // Q·v [W], with Q = F − R
    std::optional<double> distance;  // the error bound relative to ‖u‖; empty: there is none
  };
  /// How far a body that yields or slides would still go, relative to its largest displacement.
  struct Creeping {
    std::optional<double> way_left;  // infinite if the motion does not die out; empty: nothing yields or slides
    double allowed = 0;              // the way left that equilibrium takes
  };

  /// The run outlives this object.
  Measurements(RunState& run, const Model& model)
      : run_(run), error_bound_(*model.phase, model.omega_1, model.volume_norm) {}

  /// After the state has changed.
  void discard() { is_measured_ = has_residual_ = false; }
  /// All figures of the present state.
  const Figures& all();
  /// All figures as they were last measured, perhaps of an earlier state.
  const Figures& last() const { return figures_; }
  /// The residual of the present state, which costs far less than all figures: a comparison asks for it often.
  double residual();

  /// True if there may be a distance in this run.
  bool has_distance() const;
  /// The last distance, or the way left of a body that creeps if that is more: a tangent knows nothing of what still
  /// yields or slides. Empty if either is not known.
  std::optional<double> distance() const;
  /// The last distance, by which a test for equilibrium goes: relative to the displacement at the end if the scene asks
  /// for a distance, otherwise to the largest displacement so far.
  std::optional<double> distance_to_go() const;
  /// Measures the distance again by the stiffness that the body has now, if that may have changed.
  void refresh_distance();
  void forget_distance() { figures_.distance.reset(); }

  void archive(const StateArchive& state);

  Creeping creeping;  // set by the watcher of creep

 private:
  double work_in_a_step() const;

  RunState& run_;
  ErrorBound error_bound_;
  Figures figures_;
  bool is_measured_ = false;   // whether all figures are those of the present state
  bool has_residual_ = false;  // whether the residual is
};

}  // namespace stillpoint
