// Adaptive damping: critical for the mode that dominates the motion, whichever that is at the time [Underwood 1983].
//
//   M a = Q − c M v,   c = 2 √ω²,   ω² a Rayleigh quotient of the last step (rayleigh_quotient.hpp)
//
// High modes die first; what remains is slower and slower, and c falls towards 2 ω₁. Too large a c only holds the slow
// modes back until they dominate the quotient, which then falls: the estimate corrects itself. c is at most 2/k, at
// which β = 0.

#include <algorithm>
#include <cmath>

#include "solvers/relaxation/rayleigh_quotient.hpp"
#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class Adaptive final : public StaggeredIteration {
 public:
  Adaptive(const RelaxationOptions& options, RelaxationSystem& system)
      : StaggeredIteration(options, system), quotient_(options.quotient), c_(options.from.rate.value_or(0)) {}

 private:
  std::optional<double> rate() const override { return c_; }
  void propose(double h, Vec u_new, Vec v_new) override {
    const double k = kick(h);
    kick_and_drift(leapfrog(std::min(c_, 2 / k), k), k, h, u_new, v_new);
  }

  void moved(double h) override {
    const double omega_squared =
        quotient_ == Quotient::global
            ? global_quotient(v(), last_Q(), Q(), h, energy(), work())
            : diagonal_quotient(u(), v(), last_Q(), Q(), h, mass_norm_squared(u().span()), work());
    c_ = 2 * std::sqrt(omega_squared);
    set_rate(c_, h);
  }

  void archive_strategy(const StateArchive& state) override { state("c", c_); }

  Quotient quotient_;
  double c_;  // [1/s]
};

}  // namespace

std::unique_ptr<Stepper> make_adaptive(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Adaptive>(options, system);
}

}  // namespace stillpoint
