// Chebyshev's semi-iteration: the iteration of least error among all that know only the two ends of the spectrum [Golub
// and Varga, "Chebyshev semi-iterative methods", Numer. Math. 3 (1961)].
//
// On [a, b] = [ω₁², ω_max²], with d = (a + b)/2 and e = (b − a)/2:
//
//   u_{k+1} = u_k + α_k p_k,   p_k = M⁻¹Q_k + b_k p_{k−1},
//   α_0 = 1/d, b_0 = 0;   b_1 = ½ (e α_0)²,  b_k = (½ e α_{k−1})²,   α_k = 1/(d − b_k/α_{k−1}).
//
// With p = h v/α this is the staggered form: β = b_k α_k/α_{k−1}, γ = α_k/h². The coefficients tend to those of
// leapfrog with C = c M, c near 2 ω₁, at a step just below the critical one: the gain over it lies in the first 30 % of
// the iterations.
//
// h carries ω_max: the step given is the critical one, h = 2/ω_max. When a law stiffens, h becomes shorter, and the
// polynomial begins afresh on the new interval.

#include <stdexcept>

#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class Chebyshev final : public StaggeredIteration {
 public:
  Chebyshev(const RelaxationOptions& options, RelaxationSystem& system)
      : StaggeredIteration(options, system), omega_1_(options.omega_1) {
    if (!(omega_1_ > 0)) throw std::invalid_argument("the relaxation 'chebyshev' needs omega_1 > 0");
  }

 private:
  void on_restart() override { k_ = 0; }
  void max_step_changed() override { k_ = 0; }

  void propose(double h, Vec u_new, Vec v_new) override {
    const double omega_max = 2 / options().max_step;
    const double a = omega_1_ * omega_1_, b = omega_max * omega_max, d = (a + b) / 2, e = (b - a) / 2;
    double beta = 0;
    next_alpha_ = 1 / d;
    if (k_ > 0) {
      const double b_k = k_ == 1 ? e * alpha_ * (e * alpha_) / 2 : e * alpha_ / 2 * (e * alpha_ / 2);
      next_alpha_ = 1 / (d - b_k / alpha_);
      beta = b_k * next_alpha_ / alpha_ * (last_step() / h);  // h v is carried on by the recurrence
    }
    kick_and_drift({beta, next_alpha_ / (h * h)}, h, h, u_new, v_new);
  }

  void moved(double /*h*/) override {
    alpha_ = next_alpha_;
    ++k_;
  }

  void archive_strategy(const StateArchive& state) override {
    state("alpha", alpha_);
    state("k", k_);
  }

  double omega_1_;                     // [rad/s]
  double alpha_ = 0, next_alpha_ = 0;  // α_{k−1} and α_k [s²]
  long k_ = 0;                         // steps since the polynomial began
};

}  // namespace

std::unique_ptr<Stepper> make_chebyshev(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Chebyshev>(options, system);
}

}  // namespace stillpoint
