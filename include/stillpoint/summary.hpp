// The result of a run: summary.json, as data.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

enum class RunStatus {
  running,
  equilibrium,  // residual and distance ≤ their limits and kinetic energy ≤ its share of the peak, for the dwell
  unstable_equilibrium,  // in equilibrium, but K(u) has a negative eigenvalue: the least disturbance ends it
  limit_load,            // the factor of driven loads no longer grows, by stop.load_growth
  stop_test,             // ended by SimulationOptions::stop_test
  end_time,              // t = stop.time
  step_limit,            // stop.steps taken
  time_limit,            // stop.wall_time spent
  interrupted,           // by the user
  diverged,              // a state that is not finite, or a trial that cannot be evaluated
  failed                 // the integrator or the static solver gave up
};

/// "equilibrium", "end-time", ...
std::string to_string(RunStatus status);

/// A moment at which all fields were written.
struct Snapshot {
  double t = 0;            // [s]
  double slope_angle = 0;  // angle of the free surface [degrees]; NaN if there is no slope
};

/// The displacement of an elastic support, its reaction over its stiffness.
struct SupportGap {
  std::string support;   // "support[1]"
  double stiffness = 0;  // at a position [N/m], on a face per area [N/m³]
  double gap = 0;        // the largest displacement of the support [m]
  double share = 0;      // gap over the largest displacement of a material point
};

/// Error against the scene's exact solution, over the material points with weights V_p.
struct ExactError {
  double u_rel_l2 = 0, u_rel_max = 0;
  std::optional<double> stress_rel_l2;
};

/// A stage of the run that has ended.
struct StageFigures {
  double begin = 0, end = 0;              // [s]
  RunStatus status = RunStatus::running;  // equilibrium, or what a test at its end made of that; end_time: no claim
  std::string reason;                     // the inequality that told equilibrium
  double residual = 0;                    // ‖F − R‖/‖F‖ at its end
  long steps = 0;                         // up to its end
};

struct LoadFigures {                      // figures of loads that a displacement drives
  double factor = 0, largest_factor = 0;  // λ at the end, and the largest so far
  double displacement = 0;                // their mean displacement [m]
  std::optional<double> growth = {};      // (q − q₀)/(λ − λ₀) dλ/dq over the last fifth of q
};

/// The figures of a run; an empty one was not computed.
struct Summary {
  std::string scene, title;
  RunStatus status = RunStatus::running;
  std::string reason;   // the inequality that ended the run
  int exit_status = 4;  // 0 as asked, 3 not in equilibrium within the limits, 4 diverged or failed
  double t = 0;         // [s]
  long steps = 0, rejected_steps = 0, rhs_evaluations = 0;
  int phases = 1;
  std::size_t points = 0, dofs = 0;
  int threads = 1;
  int ranks = 1;  // processes that have shared the points
  double wall_s = 0, ns_per_point_step = 0;
  double bytes_per_point = 0;
  double residual = 0, kinetic_energy = 0;
  std::optional<double> distance;  // bound on the relative distance from equilibrium; for one phase with a known
                                   // omega_1
  std::string distance_kind;       // "bound", for a linear body without contact, or "estimate"; empty: no distance
  /// For a body that yields or slides: an estimate of the displacement still to come as its motion dies out, relative
  /// to the largest displacement. Infinite, null in JSON: the motion does not die out.
  std::optional<double> way_left;
  /// The stability of an equilibrium whose K(u) was tested: "stable", "neutral" or "unstable"; otherwise empty.
  std::string stability;
  std::optional<double> unstable_omega_squared;  // lowest eigenvalue of K(u), < 0 [1/s²]
  std::optional<double> omega_1;
  double omega_max = 0;
  std::optional<double> c;
  double dt = 0;  // length of the last step [s]
  std::optional<double> critical_step;
  std::string method;               // solve.method
  std::string integrator, damping;  // damping: the strategy, a damping or a relaxation
  std::vector<std::string> notes;   // remarks on the accuracy that a user should know, a sentence each
  // For an updated Lagrangian body, the worst values so far: |Σ_i m_i − Σ_p m_p|/Σ_p m_p; the change of the points'
  // momentum against the impulse of the forces and, if nothing acts on the body, momentum and angular momentum against
  // those of the start; and the inertia added to light nodes so that none shortens the step, as a share of Σ_p m_p.
  std::optional<double> mass_error, momentum_error, angular_momentum_error, added_mass;
  // The share of the points' final stresses that no function of the grid feels (null-space stress).
  std::optional<double> null_space_stress;
  std::optional<double> external_work;  // [J]
  /// Share of the plastic strain that arose while the out-of-balance force opposed the motion, where equilibrium is
  /// asked for.
  std::optional<double> plastic_overshoot;
  /// ∫ r dκ / ∫ dκ · W_p/W, r the part of ‖F − R‖/‖F‖ across the loads F, κ the plastic strain, W_p its work: the share
  /// of the loads' work W that was dissipated in plastic flow out of balance, where equilibrium is asked for. It
  /// estimates how far the displacement may be from that of a slow path.
  std::optional<double> unbalanced_plastic_work;
  /// Mean share of damping and inertia in the forces on moving supports, walls and driven loads, |∫ Q·v dt| over their
  /// work, where something drives the body and no equilibrium is asked for.
  std::optional<double> rate_share;
  /// With phase.rest: the share of the points that rested, on average over the time, and the forces that held them
  /// against what is out of balance there, Σ |Q|, as a share of the forces that pass through the body, of the phase in
  /// which it was largest.
  std::optional<double> resting_points, held_force;
  std::optional<double> single_phase_strain;  // largest component of ∂u/∂x, if a body that yields has one phase
  std::optional<double> slope_angle;          // at the end, if a probe asks for it [degrees]
  std::vector<Snapshot> snapshots;
  std::vector<StageFigures> stages;                             // before the last one, of which the other figures are
  std::map<std::string, std::vector<double>> reactions;         // forces that named supports exert on the body [N]
  std::map<std::string, std::vector<double>> reaction_moments;  // moments of the reactions about the origin, in space
                                                                // [N m]
  /// The last value of each column of history.csv that a rigid body or a contact has. In an axisymmetric scene they are
  /// of the whole body, around the axis: force_y along it, and force_x the sum of the radial components.
  std::map<std::string, double> contacts;
  std::vector<SupportGap> weak_supports;
  std::optional<LoadFigures> load;
  std::optional<ExactError> error;
  std::map<std::string, std::vector<double>> probe_positions;  // position at the start of each probe of a point [m]
  std::map<std::string, std::vector<std::pair<std::string, double>>> probes;  // name → (field, last value)
};

/// The summary as JSON text; figures that are not finite or not computed are null.
std::string to_json(const Summary& summary);

}  // namespace stillpoint
