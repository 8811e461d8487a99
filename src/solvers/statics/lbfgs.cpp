// BFGS with limited memory for R(u) = F [Nocedal, "Updating quasi-Newton matrices with limited storage", Math. Comp. 35
// (1980)]: p = H Q, of the last 10 pairs of steps (LimitedMemory). α = 1 is tried first.

#include "base/parallel_loop.hpp"
#include "solvers/relaxation/limited_memory.hpp"
#include "solvers/statics/static_iteration.hpp"
#include "solvers/statics/static_methods.hpp"

namespace stillpoint {
namespace {

class LimitedMemoryBfgs final : public StaticIteration {
 public:
  LimitedMemoryBfgs(const StaticMethodOptions& options, RelaxationSystem& system)
      : StaticIteration(options, system, {.first = 0.9, .later = 0.9}),
        memory_(system.vectors(), system.mass(), 10),
        q_(system.vectors().make(system.size())) {}

 private:
  void forget() override { memory_.forget(); }
  void load_changed() override {}  // H approximates K⁻¹, whatever the load is

  double direction(Vec p) override {
    if (memory_.empty()) {
      for_each_index(p.size(), [=, z = z().span().data()](std::size_t i) { p[i] = z[i]; });
      return shortest();
    }
    const Vec q = q_.span();
    for_each_index(q.size(), [=, from = Q().span().data()](std::size_t i) { q[i] = from[i]; });
    memory_.apply(q_);
    for_each_index(p.size(), [=](std::size_t i) { p[i] = q[i]; });
    return 1;
  }

  void moved(double alpha) override { memory_.remember(alpha, p(), last_Q(), Q()); }

  void archive_method(const StateArchive& state) override { memory_.archive(state); }

  LimitedMemory memory_;
  Vector q_;
};

}  // namespace

std::unique_ptr<Stepper> make_lbfgs(const StaticMethodOptions& options, RelaxationSystem& system) {
  return std::make_unique<LimitedMemoryBfgs>(options, system);
}

}  // namespace stillpoint
