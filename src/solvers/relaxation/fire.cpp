// The fast inertial relaxation engine: the motion is turned towards the force, moves faster and faster while it goes
// downhill, and is stopped when it goes uphill.
//
//   P = v·Q > 0:  after N_min such steps  h ← min(1.1 h, h_max),  ϑ ← 0.99 ϑ
//   P ≤ 0:        v = 0,  h ← h/2,  ϑ = ϑ_0
//   v ← v + h M⁻¹Q,   v ← (1 − ϑ) v + ϑ ‖v‖ M⁻¹Q/‖M⁻¹Q‖,   u ← u + h v
//
// fire:   ϑ_0 = 0.1, N_min = 5
//         [Bitzek, Koskinen, Gähler, Moseler, Gumbsch, Phys. Rev. Lett. 97, 170201 (2006)]
// fire2:  ϑ_0 = 0.25, N_min = 20; if P ≤ 0 also u ← u − h v/2, as the turning point lies behind, and h is left alone
//         in the first N_min steps
//         [Guénolé et al., Comput. Mater. Sci. 175, 109584 (2020)]
//
// Norms are M-norms, so that scaled masses precondition the method. The turn by ϑ ‖v‖/‖M⁻¹Q‖ lengthens the time for
// which the force acts, which the critical step does not account for: h_max is half of the step given, and h begins at
// a tenth of that. The pseudo-time advances by the step given.

#include <algorithm>
#include <cmath>

#include "base/parallel_loop.hpp"
#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

struct FireConstants {
  double theta;        // ϑ_0
  int steps_downhill;  // N_min
  bool goes_back;
};
constexpr double longest = 0.5, first = 0.05, shortest = 0.001;  // h as a share of the step given
constexpr double faster = 1.1, slower = 0.5, less_turned = 0.99;

class Fire final : public StaggeredIteration {
 public:
  Fire(const RelaxationOptions& options, RelaxationSystem& system, FireConstants constants)
      : StaggeredIteration(options, system), constants_(constants) {}

 private:
  double step_share() const override { return share_; }

  void on_restart() override {
    share_ = relaxation().from.step_share > 0 ? relaxation().from.step_share : first;
    theta_ = constants_.theta;
    downhill_ = steps_ = 0;
    uphill_ = false;
  }

  void propose(double step, Vec u_new, Vec v_new) override {
    const double h = share_ * step;
    const double keep = uphill_ ? 0 : 1, back = uphill_ && constants_.goes_back ? h / 2 : 0;
    const ConstVec u_now = u().span(), v_now = v().span(), a_now = a().span();
    for_each_index(u_now.size(), [=](std::size_t i) { v_new[i] = keep * v_now[i] + h * a_now[i]; });
    const double speed = std::sqrt(mass_norm_squared(v_new)), a_norm = std::sqrt(std::max(0.0, dot(a(), Q())));
    const double turned = a_norm > 0 ? theta_ * speed / a_norm : 0;
    for_each_index(u_now.size(), [=, straight = 1 - theta_](std::size_t i) {
      v_new[i] = straight * v_new[i] + turned * a_now[i];
      u_new[i] = u_now[i] - back * v_now[i] + h * v_new[i];
    });
  }

  void moved(double /*step*/) override {
    ++steps_;
    uphill_ = !(dot(v(), Q()) > 0);
    if (uphill_) {
      downhill_ = 0;
      if (!constants_.goes_back || steps_ > constants_.steps_downhill) share_ = std::max(slower * share_, shortest);
      theta_ = constants_.theta;
    } else if (++downhill_ > constants_.steps_downhill) {
      share_ = std::min(faster * share_, longest);
      theta_ *= less_turned;
    }
  }

  void archive_strategy(const StateArchive& state) override {
    state("share", share_);
    state("theta", theta_);
    state("downhill", downhill_);
    state("steps_taken", steps_);
    state("uphill", uphill_);
  }

  FireConstants constants_;
  double share_ = first, theta_ = 0;  // h/step and ϑ
  long downhill_ = 0, steps_ = 0;
  bool uphill_ = false;
};

}  // namespace

std::unique_ptr<Stepper> make_fire(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Fire>(options, system, FireConstants{.theta = 0.1, .steps_downhill = 5, .goes_back = false});
}

std::unique_ptr<Stepper> make_fire2(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Fire>(options, system, FireConstants{.theta = 0.25, .steps_downhill = 20, .goes_back = true});
}

}  // namespace stillpoint
