// Kinetic damping: undamped motion, brought to a halt at every peak of its kinetic energy [Cundall 1976; Barnes,
// "Form finding and analysis of tension structures by dynamic relaxation", Int. J. Space Structures 14 (1999)].
//
//   M a = Q;   if K(t) = ½ vᵀM v falls from one half step to the next:  v = 0, u back at the peak
//
// K is known at half steps: K_2 at n + ½ is less than K_1 at n − ½, K_0 at n − 3/2. The peak lies at n − ½ + s, with
//
//   half-step   s = 0
//   parabolic   s = ½ (K_0 − K_2)/(K_0 − 2 K_1 + K_2),   |s| ≤ ½
//
// and since u goes straight from n − 1 to n:   u* = u_n − (½ − s) h v_{n−½}.
//
// The fall shows before the force is evaluated at the end of the step: going back costs one evaluation, as any step.
// From rest the next step is half a kick, which is leapfrog's first step.

#include <algorithm>
#include <cmath>

#include "base/parallel_loop.hpp"
#include "solvers/relaxation/peak_of_energy.hpp"
#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class Kinetic final : public StaggeredIteration {
 public:
  Kinetic(const RelaxationOptions& options, RelaxationSystem& system)
      : StaggeredIteration(options, system), peak_(options.peak) {}

 private:
  void on_restart() override { peak_.restart(energy()); }

  void propose(double h, Vec u_new, Vec v_new) override {
    kick_and_drift({.beta = 1, .gamma = 1}, kick(h), h, u_new, v_new);
    trial_energy_ = trial_energy(v_new);  // 2 K
    falls_ = peak_.passed(trial_energy_);
    if (!falls_) return;
    const double back = peak_.steps_back(trial_energy_) * last_step();
    for_each_index(u_new.size(), [=, from = u().span().data(), velocity = v().span().data()](std::size_t i) {
      u_new[i] = from[i] - back * velocity[i];
      v_new[i] = 0;
    });
  }

  void moved(double /*h*/) override {
    if (falls_) {
      stop();
      peak_.restart(0);
    } else {
      peak_.advance(trial_energy_);
    }
  }

  void archive_strategy(const StateArchive& state) override { peak_.archive(state); }

  PeakOfEnergy peak_;
  double trial_energy_ = 0;
  bool falls_ = false;
};

}  // namespace

std::unique_ptr<Stepper> make_kinetic(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Kinetic>(options, system);
}

}  // namespace stillpoint
