// Conjugate gradients for R(u) = F, preconditioned by M [Hestenes and Stiefel 1952; nonlinear, Polak and Ribière 1969,
// with β ≥ 0: Gilbert and Nocedal, SIAM J. Optim. 2 (1992)].
//
//   z = M⁻¹Q,   p ← z + β p,   β = max(0, Q⁺·(z⁺ − z)/(Q·z)),   u ← u + α p
//
// On a linear system the line search is exact and β is Hestenes and Stiefel's: the fewest iterations of all; each costs
// two evaluations, one of which finds the stiffness along p; and α and β tell ω₁ (DescentSpectrum).

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel_loop.hpp"
#include "solvers/relaxation/descent_spectrum.hpp"
#include "solvers/statics/static_iteration.hpp"
#include "solvers/statics/static_methods.hpp"

namespace stillpoint {
namespace {

class ConjugateGradients final : public StaticIteration {
 public:
  ConjugateGradients(const StaticMethodOptions& options, RelaxationSystem& system)
      : StaticIteration(options, system, {.first = 1e-3, .later = 0.1}) {}

  std::optional<double> lowest_frequency() const override {
    const std::optional<double> squared = spectrum_.lowest();
    return squared ? std::optional(std::sqrt(*squared)) : std::nullopt;
  }

 private:
  void forget() override {
    slope_ = 0;
    spectrum_.begin();
  }

  // The first α is that of the step before, scaled as if Q·p fell by the same amount [Nocedal and Wright, eq. 3.60].
  double direction(Vec p) override {
    const double slope_of_z = dot(Q(), z());
    const double beta = slope_ > 0 ? std::max(0.0, (slope_of_z - Q_dot_last_z_) / last_Q_dot_z_) : 0;
    const double* z_now = z().span().data();
    if (slope_ > 0) {
      spectrum_.add(alpha_, beta);
      for_each_index(p.size(), [=](std::size_t i) { p[i] = z_now[i] + beta * p[i]; });
    } else {
      for_each_index(p.size(), [=](std::size_t i) { p[i] = z_now[i]; });
    }
    last_Q_dot_z_ = slope_of_z;
    const double slope = dot(Q(), this->p());
    return slope_ > 0 && slope > 0 ? alpha_ * slope_ / slope : shortest();
  }

  void moved(double alpha) override {
    alpha_ = alpha;
    slope_ = dot(last_Q(), p());
    Q_dot_last_z_ = dot(last_Q(), z());  // Q⁺·M⁻¹Q = Q·M⁻¹Q⁺
  }

  void archive_method(const StateArchive& state) override {
    state("alpha", alpha_);
    state("slope", slope_);
    state("last_Q_dot_z", last_Q_dot_z_);
    state("Q_dot_last_z", Q_dot_last_z_);
    spectrum_.archive(state.part("spectrum"));
  }

  DescentSpectrum spectrum_;
  double alpha_ = 0;
  double slope_ = 0;  // Q·p of the step before; 0: there was no step
  double last_Q_dot_z_ = 0, Q_dot_last_z_ = 0;
};

}  // namespace

std::unique_ptr<Stepper> make_cg(const StaticMethodOptions& options, RelaxationSystem& system) {
  return std::make_unique<ConjugateGradients>(options, system);
}

}  // namespace stillpoint
