// The motion of a wall: the prescribed one, or a slower one.
//
// While weights follow the body from phase to phase, a wall that jumps by a part of a cell leaves stresses in the
// points next to it that no function of the grid feels, and that no later motion removes. Hence a wall that would move
// by more than `most` within a step moves on slowly, and reaches its prescribed position within many steps:
//
//   d_{k+1} = d_k + clamp(d(t_k + h) − d_k, ±(Δ + most/4)),   Δ = |d(t_k + h) − d(t_k)|, 0 for a jump
//   w = (d_{k+1} − d_{k−1})/(2 h),   w' = (d_{k−1} − 2 d_k + d_{k+1})/h²
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "space/boundary/prescribed_motion.hpp"

namespace stillpoint {

class WallMotion {
 public:
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  explicit WallMotion(PrescribedMotion prescribed) : prescribed_(std::move(prescribed)) {}

  /// Begins a phase at t; most: largest displacement within a step [m].
  void begin_phase(double t, double most) {
    accepted_t_ = t;
    most_ = most;
  }
  /// Accepts a step to t.
  void step_to(double t) {
    const At next = after(now_, t);
    step_ = t - accepted_t_;
    accepted_t_ = t;
    before_ = now_;
    now_ = next;
    furthest_behind_ = std::max(furthest_behind_, now_.is_late ? std::abs(now_.asked - before_.place) : 0.0);
  }

  /// Length of the last step; 0: there was none [s].
  double step() const { return step_; }
  /// Displacement after the last step [m].
  double displacement() const { return now_.place; }
  /// Velocity at t, the end of the last step or of the next one [m/s].
  double velocity(double t) const {
    const std::optional<Three> own = own_way(t);
    return own ? (own->next - own->before) / (2 * step_) : prescribed_.velocity(t);
  }
  /// Velocity [m/s] and acceleration [m/s²] at t by the differences of a step of the last step's length.
  double velocity_over_step(double t) const {
    if (const std::optional<Three> own = own_way(t)) return (own->next - own->before) / (2 * step_);
    return step_ > 0 ? prescribed_.velocity_over(t, step_) : prescribed_.velocity(t);
  }
  double acceleration_over_step(double t) const {
    if (const std::optional<Three> own = own_way(t)) return (own->before - 2 * own->at + own->next) / (step_ * step_);
    return step_ > 0 ? prescribed_.acceleration_over(t, step_) : prescribed_.acceleration(t);
  }

  bool is_late() const { return now_.is_late; }
  /// The largest distance so far behind the prescribed motion; 0 if the wall always followed it [m].
  double furthest_behind() const { return furthest_behind_; }

  void archive(const StateArchive& state) {
    state("accepted_t", accepted_t_);
    state("step", step_);
    now_.archive(state.part("wall_now"));
    before_.archive(state.part("wall_before"));
    state("furthest_behind", furthest_behind_);
  }

 private:
  // After a step: the prescribed displacement and the actual one [m].
  struct At {
    double asked = 0, place = 0;
    bool is_late = false;

    void archive(const StateArchive& state) {
      state("asked", asked);
      state("place", place);
      state("is_late", is_late);
    }
  };
  // The displacements a step before t, at t and a step after t [m].
  struct Three {
    double before, at, next;
  };

  // The state after a step that ends at t.
  At after(const At& from, double t) const {
    const double asked = prescribed_.displacement(t), behind = asked - from.place;
    if (!from.is_late && std::abs(behind) <= most_) return {asked, asked, false};
    const double regular = std::abs(asked - from.asked), limit = (regular <= most_ ? regular : 0) + most_ / 4;
    if (std::abs(behind) <= limit) return {asked, asked, false};
    return {asked, from.place + std::copysign(limit, behind), true};
  }
  // The slower motion at t; empty if the wall follows the formula.
  std::optional<Three> own_way(double t) const {
    if (most_ == unlimited || !(step_ > 0)) return std::nullopt;
    const bool is_next = t > accepted_t_ + step_ / 2;
    const At before = is_next ? now_ : before_, at = is_next ? after(now_, t) : now_, next = after(at, t + step_);
    if (!before.is_late && !at.is_late && !next.is_late) return std::nullopt;
    return Three{before.place, at.place, next.place};
  }

  PrescribedMotion prescribed_;
  double most_ = unlimited;           // [m]
  double accepted_t_ = 0, step_ = 0;  // end and length of the last step; 0: none yet [s]
  At now_, before_;                   // states after the last step, and after the one before it
  double furthest_behind_ = 0;
};

}  // namespace stillpoint
