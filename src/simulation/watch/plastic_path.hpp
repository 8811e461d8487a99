// Plastic flow depends on the way to rest: this tells if a body yielded along the way on which a slowly growing load
// takes it.
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

#include <optional>
#include <vector>

#include "simulation/watcher.hpp"

namespace stillpoint {

class PlasticPath : public Watcher {
 public:
  /// Watches if anything can yield here, and equilibrium is asked for. The run outlives this object.
  explicit PlasticPath(const RunState& run);

  /// Takes 32 samples in a period of the body. With a static solver, which yields all at once, it takes one at the
  /// beginning and one at the end.
  void observe(RunState& run) override {
    if (watches_ && run.t >= next_) sample(run);
  }
  void end_phase(RunState& run, bool is_last) override;
  void fill(Summary& summary, const RunState& run) override;
  void fill_state(Summary& summary, RunState& run) override;
  void archive(const StateArchive& state, RunState& run) override;

 private:
  void sample(RunState& run);
  std::optional<double> overshoot() const;
  std::optional<double> unbalanced_work(double t, ConstVec u) const;
  double plastic_work(double t, ConstVec u) const;
  double across_loads(double t, const RelaxationSystem& system);
  double work(double t, const PhaseMotion& motion) const;

  const Model& model_;
  const GivingWay& giving_way_;
  bool watches_;
  double interval_ = 0, next_ = 0;       // time between samples, and that of the next one [s]
  double imbalance_ = 0, power_ = 0;     // r and Q·v at the last sample
  double first_ = 0, last_ = 0;          // κ at the first and at the last sample [m³]
  double against_ = 0, unbalanced_ = 0;  // ∫_{Q·v<0} dκ, ∫ r dκ [m³]
  double earlier_work_ = 0, work_ = 0;   // W of the phases before, the largest W so far [J]
  bool begun_ = false;
  std::vector<double> Q_;  // (n) [N]
};

}  // namespace stillpoint
