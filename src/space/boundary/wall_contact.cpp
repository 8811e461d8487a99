#include "space/boundary/wall_contact.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace stillpoint {

WallContact::WallContact(std::string name, bool upper, double friction, PrescribedMotion motion)
    : name_(std::move(name)), outward_(upper ? 1 : -1), friction_(friction), motion_(std::move(motion)) {}

void WallContact::begin_phase(double t, ConstVec mass, std::vector<Node> nodes, Vec v) {
  mass_ = mass;
  nodes_ = std::move(nodes);
  closed_.resize(nodes_.size(), 0);
  tangential_.resize(nodes_.size(), Tangential::stick);
  normal_force_.assign(nodes_.size(), 0);
  shear_force_.assign(nodes_.size(), 0);
  held_.assign(nodes_.size(), 0);
  start_ = motion_.displacement(t);
  accepted_t_ = t;
  const double velocity = motion_.velocity(t);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (nodes_[k].normal < 0) {
      closed_[k] = 0;
      continue;
    }
    if (!started_) {
      closed_[k] = 1;
      continue;
    }
    if (closed_[k] || approaches(k, velocity, v)) close(k, velocity, v);
  }
}

bool WallContact::approaches(std::size_t k, double velocity, ConstVec v) const {
  return outward_ * (v[static_cast<std::size_t>(nodes_[k].normal)] - velocity) >= 0;
}

bool WallContact::close(std::size_t k, double velocity, Vec v) {
  const auto normal = static_cast<std::size_t>(nodes_[k].normal);
  bool changed = v[normal] != velocity;
  v[normal] = velocity;
  const bool was_closed = closed_[k] != 0;
  closed_[k] = 1;
  if (nodes_[k].tangential < 0 || friction_ == 0) return changed;
  double& v_t = v[static_cast<std::size_t>(nodes_[k].tangential)];
  if (std::isinf(friction_) || (was_closed && tangential_[k] == Tangential::stick)) {
    changed = changed || v_t != 0;
    v_t = 0;
    tangential_[k] = Tangential::stick;
  } else {
    tangential_[k] = v_t > 0 ? Tangential::slip_up : v_t < 0 ? Tangential::slip_down : Tangential::stick;
  }
  return changed;
}

void WallContact::add_force(double t, const LinearDamping& C, Vec Q) const {
  const double w = step_ > 0 ? motion_.velocity_over(t, step_) : motion_.velocity(t);
  const double a = step_ > 0 ? motion_.acceleration_over(t, step_) : motion_.acceleration(t);
  const ConstVec m = mass_;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    normal_force_[k] = shear_force_[k] = 0;
    if (!closed_[k]) continue;
    const auto n = static_cast<std::size_t>(nodes_[k].normal);
    held_[k] = m[n] * a + (C.mass * m[n] + C.identity) * w;
    normal_force_[k] = held_[k] - Q[n];
    Q[n] = held_[k];
    if (nodes_[k].tangential < 0 || friction_ == 0) continue;
    double& Q_t = Q[static_cast<std::size_t>(nodes_[k].tangential)];
    if (tangential_[k] == Tangential::stick) {
      shear_force_[k] = -Q_t;
    } else {
      const double limit = friction_ * std::max(0.0, -outward_ * normal_force_[k]);
      shear_force_[k] = -limit * static_cast<double>(tangential_[k]);
    }
    Q_t += shear_force_[k];
  }
}

void WallContact::hold(Vec Q) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (closed_[k]) Q[static_cast<std::size_t>(nodes_[k].normal)] = held_[k];
  }
}

bool WallContact::update(double t, ConstVec u, Vec v) {
  const double velocity = motion_.velocity(t), moved = motion_.displacement(t) - start_;
  step_ = t - accepted_t_;
  accepted_t_ = t;
  bool changed = false;
  if (!started_) {
    started_ = true;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!closed_[k]) continue;
      closed_[k] = outward_ * normal_force_[k] < 0 || approaches(k, velocity, v);
      if (closed_[k]) changed = close(k, velocity, v) || changed;
    }
  }
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (nodes_[k].normal < 0) continue;
    const auto n = static_cast<std::size_t>(nodes_[k].normal);
    if (!closed_[k]) {
      const bool touches = outward_ * (u[n] - moved) >= 0 && outward_ * (v[n] - velocity) > 0;
      if (touches) changed = close(k, velocity, v) || changed;
      continue;
    }
    if (outward_ * normal_force_[k] > 0) {
      closed_[k] = 0;
      continue;
    }
    if (nodes_[k].tangential < 0 || std::isinf(friction_) || friction_ == 0) continue;
    double& v_t = v[static_cast<std::size_t>(nodes_[k].tangential)];
    if (tangential_[k] == Tangential::stick) {
      // F_t = −Q_t holds it; what exceeds the limit makes it slip the way of Q_t.
      if (std::abs(shear_force_[k]) > friction_ * std::abs(normal_force_[k])) {
        tangential_[k] = shear_force_[k] < 0 ? Tangential::slip_up : Tangential::slip_down;
      }
    } else if (v_t * static_cast<double>(tangential_[k]) < 0) {
      tangential_[k] = Tangential::stick;
      v_t = 0;
      changed = true;
    }
  }
  return changed;
}

// On the wall: minus the forces on the body. Power on the body: Σ F_n w.
WallReaction WallContact::reaction(double t) const {
  WallReaction sum{.name = name_, .displacement = motion_.displacement(t)};
  double force = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    sum.normal -= outward_ * normal_force_[k];
    sum.shear -= shear_force_[k];
    force += normal_force_[k];
  }
  sum.power = force * motion_.velocity(t);
  return sum;
}

void WallContact::archive(const StateArchive& state) {
  state("closed", closed_);
  state("tangential", tangential_);
  state("started", started_);
  state("displacement_at_start", start_);
  state("accepted_t", accepted_t_);
  state("step", step_);
  state("held", held_);
  state("normal_force", normal_force_);
  state("shear_force", shear_force_);
  if (!state.restores()) return;
  const std::size_t saved = closed_.size();
  for (const std::size_t size : {tangential_.size(), held_.size(), normal_force_.size(), shear_force_.size()})
    if (size != saved) throw StateError(fmt::format("of the wall '{}' the numbers of nodes differ", name_));
  // The nodes are those of the phase that is restored, or before it begins some others.
  closed_.resize(nodes_.size(), 0);
  tangential_.resize(nodes_.size(), Tangential::stick);
  for (auto* const forces : {&held_, &normal_force_, &shear_force_}) forces->resize(nodes_.size(), 0);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k].normal < 0) closed_[k] = 0;
}

double WallContact::square_of_forces() const {
  double sum = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    sum += normal_force_[k] * normal_force_[k] + shear_force_[k] * shear_force_[k];
  }
  return sum;
}

}  // namespace stillpoint
