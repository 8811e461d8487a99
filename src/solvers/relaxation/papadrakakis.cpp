// Critical damping by the decay of the motion [Papadrakakis, "A method for the automatic evaluation of the dynamic
// relaxation parameters", Comput. Methods Appl. Mech. Eng. 25 (1981)].
//
//   M a = Q − c M v,   c = 2 ω₁
//
// Near equilibrium each mode of u_{n+1} = u_n + β (u_n − u_{n−1}) + γ h² M⁻¹Q behaves as a power λⁿ,
//
//   λ² − (1 + β − γ h² ω²) λ + β = 0,
//
// and if damping is more than critical the slowest λ is real: the ratio λ = ‖Δu_{n+1}‖/‖Δu_n‖, in the M-norm,
// settles on it and gives ω₁² = −(λ² − (1 + β) λ + β)/(γ h² λ). It starts with β = 0, more than critical for every
// mode; each time that λ has settled, c is set by the ω₁ it shows. A ratio that settles before the slowest mode
// dominates shows a larger ω: c comes down to 2 ω₁ in a few such steps.

#include <algorithm>
#include <cmath>

#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class Papadrakakis final : public StaggeredIteration {
 public:
  Papadrakakis(const RelaxationOptions& options, RelaxationSystem& system)
      : StaggeredIteration(options, system), rate_(options.from.rate) {}

 private:
  std::optional<double> rate() const override { return rate_; }
  // Kicks are full ones also from rest, so that β and γ are those of the formula above.
  void propose(double h, Vec u_new, Vec v_new) override {
    now_ = leapfrog(std::min(rate_.value_or(2 / h), 2 / h), h);
    kick_and_drift(now_, h, h, u_new, v_new);
  }

  void on_restart() override { forget(); }

  void moved(double h) override {
    const double size = h * std::sqrt(energy());  // ‖Δu‖
    const double ratio = size / size_, change = std::abs(ratio - ratio_);
    constexpr double settled = 0.01;  // change of λ in a step, as a share of its distance from 1
    if (ratio < 1 && change < settled * (1 - ratio)) {
      const double omega_squared =
          -(ratio * ratio - (1 + now_.beta) * ratio + now_.beta) / (now_.gamma * h * h * ratio);
      if (omega_squared > 0) {
        rate_ = 2 * std::sqrt(omega_squared);
        set_rate(*rate_, h);
        forget();
        return;
      }
    }
    size_ = size;
    ratio_ = ratio;
  }

  void forget() { size_ = ratio_ = 0; }

  void archive_strategy(const StateArchive& state) override {
    state("rate", rate_);
    state("size", size_);
    state("ratio", ratio_);
  }

  Coefficients now_{.beta = 0, .gamma = 0.5};
  std::optional<double> rate_;   // c [1/s]; none: β = 0
  double size_ = 0, ratio_ = 0;  // M-norm of the last Δu, and its ratio to the one before; 0: not known
};

}  // namespace

std::unique_ptr<Stepper> make_papadrakakis(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Papadrakakis>(options, system);
}

}  // namespace stillpoint
