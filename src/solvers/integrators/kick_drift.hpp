// The kick and the drift of the staggered schemes, v⁺ = v + k a, u⁺ = u + h v⁺. If y = [u; p], the momentum is kicked
// as the velocity of a unit mass would be, p' = Q − c p, and M⁻¹ enters in the drift, u⁺ = u + h M⁻¹p⁺.
#pragma once

#include <stillpoint/relaxation_system.hpp>

#include <optional>
#include <vector>

#include "base/parallel_loop.hpp"

namespace stillpoint {

class KickDrift {
 public:
  /// The system has to outlive this object.
  explicit KickDrift(const RelaxationSystem& system) : mass_(system.mass()) {
    if (!system.keeps_momentum()) return;
    unit_ = Mass::lumped(std::vector<double>(system.size(), 1.0));
    velocity_ = system.vectors().make(system.size());
  }

  /// The mass by which Q is divided to give the a of the kick.
  const Mass& mass_of_kick() const { return unit_ ? *unit_ : mass_; }
  /// Kicks v by k a into v_new and drifts u by h into u_new. v, v_new: velocities or momenta; all (n).
  void operator()(double k, ConstVec a, double h, ConstVec u, ConstVec v, Vec u_new, Vec v_new) {
    if (!velocity_) {
      for_each_index(u.size(), [=](std::size_t i) {
        v_new[i] = v[i] + k * a[i];
        u_new[i] = u[i] + h * v_new[i];
      });
      return;
    }
    for_each_index(u.size(), [=](std::size_t i) { v_new[i] = v[i] + k * a[i]; });
    mass_.solve(v_new, velocity_->span());
    for_each_index(u.size(), [=, v = velocity_->span().data()](std::size_t i) { u_new[i] = u[i] + h * v[i]; });
  }

 private:
  const Mass& mass_;
  std::optional<Mass> unit_;
  std::optional<Vector> velocity_;  // M⁻¹p, (n)
};

}  // namespace stillpoint
