// Nesterov's accelerated gradient with adaptive restart [Nesterov, Soviet Math. Dokl. 27 (1983); O'Donoghue and Candès,
// "Adaptive restart for accelerated gradient schemes", Found. Comput. Math. 15 (2015), gradient scheme].
//
//   x_{k+1} = u_k + s M⁻¹Q(u_k),   s = (h/2)² ≤ 1/ω_max²
//   θ_{k+1} = (1 + √(1 + 4 θ_k²))/2,   u_{k+1} = x_{k+1} + (θ_k − 1)/θ_{k+1} (x_{k+1} − x_k),   θ_0 = 1
//   if Q(u_k)·(x_{k+1} − x_k) < 0, uphill:  θ_k = 1
//
// Only the upper end of the spectrum is needed, and h carries it. v is (u_{k+1} − u_k)/h.

#include <cmath>
#include <utility>

#include "base/parallel_loop.hpp"
#include "solvers/relaxation/relaxations.hpp"
#include "solvers/relaxation/staggered_iteration.hpp"

namespace stillpoint {
namespace {

class Nesterov final : public StaggeredIteration {
 public:
  Nesterov(const RelaxationOptions& options, RelaxationSystem& system)
      : StaggeredIteration(options, system),
        x_(system.vectors().make(system.size())),
        next_x_(system.vectors().make(system.size())) {}

 private:
  void on_restart() override {
    theta_ = 1;
    const Vec x = x_.span();
    for_each_index(x.size(), [=, from = u().span().data()](std::size_t i) { x[i] = from[i]; });
  }

  void propose(double h, Vec u_new, Vec v_new) override {
    const ConstVec u_now = u().span(), a_now = a().span(), x = x_.span();
    const Vec x_new = next_x_.span(), dx = work().span();
    for_each_index(x.size(), [=, s = h * h / 4](std::size_t i) {
      x_new[i] = u_now[i] + s * a_now[i];
      dx[i] = x_new[i] - x[i];
    });
    const double theta = dot(Q(), work()) < 0 ? 1 : theta_;  // uphill: begin afresh
    next_theta_ = (1 + std::sqrt(1 + 4 * theta * theta)) / 2;
    for_each_index(x.size(), [=, momentum = (theta - 1) / next_theta_](std::size_t i) {
      u_new[i] = x_new[i] + momentum * dx[i];
      v_new[i] = (u_new[i] - u_now[i]) / h;
    });
  }

  void moved(double /*h*/) override {
    std::swap(x_, next_x_);
    theta_ = next_theta_;
  }

  void archive_strategy(const StateArchive& state) override {
    state("x", x_.span());
    state("theta", theta_);
  }

  Vector x_, next_x_;  // x_k and x_{k+1}, (n)
  double theta_ = 1, next_theta_ = 1;
};

}  // namespace

std::unique_ptr<Stepper> make_nesterov(const RelaxationOptions& options, RelaxationSystem& system) {
  return std::make_unique<Nesterov>(options, system);
}

}  // namespace stillpoint
