// Whether what yielded did so along the way that a load which grows slowly takes.
//
// A motion is a slow path itself, that of the load R(t) which its internal forces bear. If R keeps the direction of the
// loads F and grows, a ramp of them does the same, however fast it was. So two figures tell how far a motion was from
// one, with Q = F − R the out-of-balance force, Q_⊥ its part normal to F, and κ = Σ_p V_p γᵖ_p the plastic strain of
// all points:
//
//   overshoot         ∫_{Q·v<0} dκ / ∫ dκ: the share that yielded while inertia carried the body on against forces that
//                     held it back already. It grows with the settlement that is too much: on three bodies that yield,
//                     by twelve strategies, it ranks them as the difference from a slow ramp does, which neither the
//                     energy that damping takes, nor the largest kinetic energy or strain energy beside the last one
//                     do.
//   unbalanced work   ∫ r dκ / ∫ dκ · W_p/W: how far off the direction of the loads the body yielded, and how much that
//                     matters,  r = ‖Q_⊥‖/‖F‖,  W_p = Σ_p V_p √J₂ γᵖ,  W the largest ½ (|F·u| + |R·u|) + |R_s·u_s| on
//                     the way, of loads and supports: at rest W = ∫ σ : ε dV, and W_p/W is the plastic share of it.
//
// Both are 0 of a slow ramp and of an elastic body. The first sees nothing of a body that yields along another way
// without going too far: under a sudden load stresses run ahead of it in waves.
#pragma once

#include <stillpoint/relaxation_system.hpp>

#include <optional>
#include <string>
#include <vector>

#include "simulation/setup/model.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

class PlasticPath {
 public:
  /// The model outlives it.
  PlasticPath(const Problem& problem, const Model& model);

  /// Whether anything can yield here, and equilibrium is asked for.
  bool watches() const { return watches_; }
  /// Whether it wants a sample: 32 times in a period of the body, of a static solver, which yields all at once, when it
  /// begins and ends.
  bool due(double t) const { return watches_ && t >= next_; }
  /// At (t, u), where the system was evaluated last; residual: ‖Q‖/‖F‖; power: Q·v [W].
  void sample(double t, RelaxationSystem& system, const Vector& u, double residual, double power);
  void end_phase(double t, RelaxationSystem& system, const Vector& u);

  /// Empty: nothing has yielded.
  std::optional<double> overshoot() const;
  /// At (t, u).
  std::optional<double> unbalanced_work(double t, ConstVec u) const;

  void archive(const StateArchive& state) {
    state("next", next_);
    state("imbalance", imbalance_);
    state("power", power_);
    state("first", first_);
    state("last", last_);
    state("against", against_);
    state("unbalanced", unbalanced_);
    state("earlier_work", earlier_work_);
    state("work", work_);
    state("begun", begun_);
  }

 private:
  const std::vector<double>& plastic_strain() const;
  double total_plastic_strain() const;
  double plastic_work(double t, ConstVec u) const;
  double across_loads(double t, const RelaxationSystem& system);
  double work(double t, RelaxationSystem& system, const Vector& u) const;

  const Model& model_;
  bool watches_ = false;
  double interval_ = 0, next_ = 0;       // [s]
  double imbalance_ = 0, power_ = 0;     // at the last sample
  double first_ = 0, last_ = 0;          // κ at the first and at the last sample [m³]
  double against_ = 0, unbalanced_ = 0;  // ∫_{Q·v<0} dκ, ∫ r dκ [m³]
  double earlier_work_ = 0, work_ = 0;   // W of the phases before, the largest W so far [J]
  bool begun_ = false;
  std::vector<double> Q_;                  // (n) [N]
  std::vector<double> volumes_;            // at the start, (P) [m³]
  mutable std::vector<double> of_points_;  // γᵖ, (P)
};

/// What to say of them; empty: nothing.
std::string note_on_overshoot(std::optional<double> overshoot);
std::string note_on_unbalanced_work(std::optional<double> unbalanced_work, const Model& model);

}  // namespace stillpoint
