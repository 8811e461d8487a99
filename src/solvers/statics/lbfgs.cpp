// BFGS with limited memory for R(u) = F [Nocedal, "Updating quasi-Newton matrices with limited storage", Math. Comp. 35
// (1980)].
//
//   p = H Q,  H the two-loop recursion over the last 10 pairs  s = α p,  y = Q − Q⁺,  on  H_0 = (s·y/y·M⁻¹y) M⁻¹
//
// α = 1 is tried first. A pair with s·y ≤ 0, no positive stiffness along s, is left out.

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "solvers/statics/static_iteration.hpp"
#include "solvers/statics/static_methods.hpp"

namespace stillpoint {
namespace {

class LimitedMemoryBfgs final : public StaticIteration {
  static constexpr std::size_t memory = 10;

 public:
  LimitedMemoryBfgs(double max_step, RelaxationSystem& system)
      : StaticIteration(max_step, system, {.first = 0.9, .later = 0.9}),
        q_(system.vectors().make(system.size())),
        mass_(system.system().mass()) {
    for (std::size_t k = 0; k < memory; ++k) {
      s_.push_back(system.vectors().make(system.size()));
      y_.push_back(system.vectors().make(system.size()));
    }
  }

 private:
  void forget() override { kept_ = 0; }

  double direction(Vec p) override {
    if (kept_ == 0) {
      for_each_index(p.size(), [=, z = z().span().data()](std::size_t i) { p[i] = z[i]; });
      return shortest();
    }
    const Vec q = q_.span();
    for_each_index(q.size(), [=, from = Q().span().data()](std::size_t i) { q[i] = from[i]; });
    std::array<double, memory> a{};
    for (std::size_t age = 0; age < kept_; ++age) {  // the newest first
      const std::size_t k = slot(age);
      a[age] = dot(s_[k], q_) / sy_[k];
      for_each_index(q.size(), [=, a = a[age], y = y_[k].span().data()](std::size_t i) { q[i] -= a * y[i]; });
    }
    mass_.solve(q_.span(), q_.span());
    for_each_index(q.size(), [=, scale = scale_](std::size_t i) { q[i] *= scale; });
    for (std::size_t age = kept_; age-- > 0;) {
      const std::size_t k = slot(age);
      const double b = dot(y_[k], q_) / sy_[k];
      for_each_index(q.size(), [=, d = a[age] - b, s = s_[k].span().data()](std::size_t i) { q[i] += d * s[i]; });
    }
    for_each_index(p.size(), [=](std::size_t i) { p[i] = q[i]; });
    return 1;
  }

  void moved(double alpha) override {
    const std::size_t k = (newest_ + 1) % memory;
    const Vec s = s_[k].span(), y = y_[k].span();
    const double *step = p().span().data(), *before = last_Q().span().data(), *now = Q().span().data();
    for_each_index(s.size(), [=](std::size_t i) {
      s[i] = alpha * step[i];
      y[i] = before[i] - now[i];
    });
    sy_[k] = dot(s_[k], y_[k]);
    mass_.solve(y_[k].span(), q_.span());
    const double yMy = dot(y_[k], q_);
    if (!(sy_[k] > 0) || !(yMy > 0)) {
      kept_ = std::min(kept_, memory - 1);  // its place was that of the oldest
      return;
    }
    scale_ = sy_[k] / yMy;
    newest_ = k;
    kept_ = std::min(kept_ + 1, memory);
  }

  void archive_method(const StateArchive& state) override {
    for (std::size_t k = 0; k < memory; ++k) {
      state(fmt::format("s_{}", k), s_[k].span());
      state(fmt::format("y_{}", k), y_[k].span());
    }
    state("sy", sy_);
    state("scale", scale_);
    state("newest", newest_);
    state("kept", kept_);
    if (newest_ >= memory || kept_ > memory) throw StateError("its pairs of steps are not in the ring of 'lbfgs'");
  }

  std::size_t slot(std::size_t age) const { return (newest_ + memory - age) % memory; }

  std::vector<Vector> s_, y_;  // a ring, (memory) of (n)
  std::array<double, memory> sy_{};
  Vector q_;
  const Mass& mass_;
  double scale_ = 1;  // s·y/y·M⁻¹y of the newest pair
  std::size_t newest_ = 0, kept_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> make_lbfgs(const StaticMethodOptions& options, RelaxationSystem& system) {
  return std::make_unique<LimitedMemoryBfgs>(options.max_step, system);
}

}  // namespace stillpoint
