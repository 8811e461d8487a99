#include "space/boundary/wall_contact.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "scene/body_depth.hpp"

namespace stillpoint {
namespace {

std::vector<double> components_of(const std::vector<std::array<double, 2>>& of_nodes) {
  std::vector<double> components;
  for (const auto& node : of_nodes) components.insert(components.end(), node.begin(), node.end());
  return components;
}

std::vector<std::array<double, 2>> in_nodes(const std::vector<double>& components) {
  std::vector<std::array<double, 2>> of_nodes(components.size() / 2);
  for (std::size_t k = 0; k < of_nodes.size(); ++k) of_nodes[k] = {components[2 * k], components[2 * k + 1]};
  return of_nodes;
}

}  // namespace

WallContact::WallContact(std::string name, bool upper, double friction, WallMotion motion)
    : name_(std::move(name)), outward_(upper ? 1 : -1), friction_(friction), motion_(std::move(motion)) {}

void WallContact::begin_phase(const Phase& phase, ConstVec mass, std::vector<Node> nodes, Vec v) {
  const auto known = [this](std::size_t k) { return stays(k); };
  // A body with history flows: once it has touched a wall, the initial depths of its points no longer tell which
  // material touches the wall, nor anything as small as the depth by which a point is pressed into the wall.
  bool flows = false;
  for (std::size_t k = 0; k < closed_.size(); ++k) flows = flows || (phase.remembers && known(k));
  const double near = (flows ? 0.5 : touching) * phase.cell;
  std::vector<double> gap(nodes.size(), 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!known(k)) gap[k] = phase.remembers ? std::max(0.0, nodes[k].gap) : nodes[k].gap;
    if (std::abs(gap[k]) <= near) gap[k] = 0;
  }
  mass_ = mass;
  nodes_ = std::move(nodes);
  gap_ = std::move(gap);
  closed_.resize(nodes_.size(), 0);
  sliding_.resize(nodes_.size(), Along{});
  normal_force_.assign(nodes_.size(), 0);
  shear_force_.assign(nodes_.size(), Along{});
  brakes_.assign(nodes_.size(), 0);
  held_.assign(nodes_.size(), 0);
  closed_across_gap_ = false;
  cell_ = phase.cell;
  start_ = phase.face_at;
  motion_.begin_phase(phase.t, phase.most);
  const double velocity = motion_.velocity(phase.t);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const bool may_touch = nodes_[k].normal >= 0 && gap_[k] <= 0;
    if (!started_ || !may_touch) {
      closed_[k] = may_touch;
    } else if (closed_[k] || approaches(k, velocity, v)) {
      close(k, velocity, v);
    }
  }
}

void WallContact::take_nodes(const std::vector<std::size_t>& from) {
  const auto take = [&](auto& values) {
    std::remove_reference_t<decltype(values)> taken(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
      if (from[k] != is_new && from[k] < values.size()) taken[k] = values[from[k]];
    values = std::move(taken);
  };
  take(closed_);
  take(sliding_);
  take(gap_);
}

bool WallContact::approaches(std::size_t k, double velocity, ConstVec v) const {
  return outward_ * (v[static_cast<std::size_t>(nodes_[k].normal)] - velocity) >= 0;
}

WallContact::Along WallContact::along(std::size_t k, ConstVec values) const {
  Along out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (nodes_[k].along[i] >= 0) out[i] = values[static_cast<std::size_t>(nodes_[k].along[i])];
  }
  return out;
}

// Sets v_t = 0 at a node. Returns whether it was different.
bool WallContact::stop_along(std::size_t k, Vec v) {
  const bool moved = along(k, v) != Along{};
  for (const int dof : nodes_[k].along) {
    if (dof >= 0) v[static_cast<std::size_t>(dof)] = 0;
  }
  sliding_[k] = {};
  return moved;
}

// Slides a node after a step. A node that friction brings to rest stays at rest, unless the step was shorter than the
// one before. Returns whether v was changed.
bool WallContact::slide(std::size_t k, Vec v) {
  constexpr double hardly = 1e-6;
  const Along v_t = along(k, v), before = sliding_[k];
  const double forwards = v_t[0] * before[0] + v_t[1] * before[1];
  const bool rests = forwards <= hardly * (before[0] * before[0] + before[1] * before[1]);
  if (brakes_[k] && rests) return stop_along(k, v);
  sliding_[k] = v_t;
  return false;
}

bool WallContact::close(std::size_t k, double velocity, Vec v) {
  const auto normal = static_cast<std::size_t>(nodes_[k].normal);
  bool changed = v[normal] != velocity;
  v[normal] = velocity;
  closed_[k] = 1;
  if (friction_ == 0) return changed;
  if (std::isinf(friction_)) return stop_along(k, v) || changed;
  sliding_[k] = along(k, v);
  return changed;
}

void WallContact::add_force(double t, const LinearDamping& C, Vec Q) const {
  const double w = motion_.velocity_over_step(t), a = motion_.acceleration_over_step(t);
  const double over_h = motion_.step() > 0 ? 1 / motion_.step() : 0;
  const ConstVec m = mass_;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    normal_force_[k] = 0;
    shear_force_[k] = {};
    if (!closed_[k]) continue;
    const auto n = static_cast<std::size_t>(nodes_[k].normal);
    held_[k] = m[n] * a + (C.mass * m[n] + C.identity) * w;
    normal_force_[k] = held_[k] - Q[n];
    Q[n] = held_[k];
    if (friction_ == 0) continue;
    const Along Q_t = along(k, Q);
    const double limit = std::isinf(friction_) ? friction_ : friction_ * std::max(0.0, -outward_ * normal_force_[k]);
    Along S{};
    for (std::size_t i = 0; i < S.size(); ++i) {
      const int dof = nodes_[k].along[i];
      if (dof < 0) continue;
      const double inertia = m[static_cast<std::size_t>(dof)];
      S[i] = Q_t[i] + std::max(0.0, over_h * inertia - (C.mass * inertia + C.identity) / 2) * sliding_[k][i];
    }
    const double needed = std::hypot(S[0], S[1]), share = needed > limit ? limit / needed : 1;
    brakes_[k] = share == 1;
    for (std::size_t i = 0; i < S.size(); ++i) {
      if (nodes_[k].along[i] < 0) continue;
      shear_force_[k][i] = -share * S[i];
      Q[static_cast<std::size_t>(nodes_[k].along[i])] += shear_force_[k][i];
    }
  }
}

void WallContact::hold(Vec Q) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (closed_[k]) Q[static_cast<std::size_t>(nodes_[k].normal)] = held_[k];
  }
}

ContactChange WallContact::update(double t, Vec u, Vec v) {
  motion_.step_to(t);
  const double velocity = motion_.velocity(t), wall = motion_.displacement() - start_;
  const double rounding = 1e-11 * cell_, near = 1e-3 * cell_;
  ContactChange change = ContactChange::nothing;
  const auto changes = [&](bool changed, ContactChange what) {
    if (changed) change = std::max(change, what);
  };
  const bool begins = !std::exchange(started_, true);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (nodes_[k].normal < 0) continue;
    const auto n = static_cast<std::size_t>(nodes_[k].normal);
    const double past = outward_ * (u[n] - touches_at(k, wall));
    const bool pulls = outward_ * normal_force_[k] > 0;
    const auto put_back = [&] {
      // A step usually overshoots the wall by so little that the force may wait until the next step.
      const bool far = std::abs(past) > 1e-2 * cell_;
      changes(u[n] != touches_at(k, wall), far ? ContactChange::displacement : ContactChange::velocity);
      put_back_ = std::max(put_back_, std::abs(past));
      u[n] = touches_at(k, wall);
    };
    if (begins && closed_[k])
      closed_[k] = past >= -rounding && (past > rounding || !pulls || approaches(k, velocity, v));
    if (!closed_[k]) {
      const bool arrives = outward_ * (v[n] - velocity) > 0;
      if (!(past > rounding || (past >= -rounding && arrives))) continue;
      put_back();
      changes(close(k, velocity, v), ContactChange::velocity);
      closed_across_gap_ = closed_across_gap_ || gap_[k] > near;
      continue;
    }
    if (begins) changes(close(k, velocity, v), ContactChange::velocity);
    // A node that is pressed against the wall stays closed if a step ends slightly off it: released, it would fly off
    // and come back.
    const bool is_left = past < -(pulls ? near : 10 * near);
    if (is_left || (pulls && past <= rounding)) {
      closed_[k] = 0;
      continue;
    }
    if (std::abs(past) > rounding) {
      put_back();
      changes(close(k, velocity, v), ContactChange::velocity);
    }
    if (std::isinf(friction_) || friction_ == 0) continue;
    changes(slide(k, v), ContactChange::velocity);
  }
  return change;
}

bool WallContact::asks_for_next_phase() const {
  constexpr double far = 0.5;  // share of a cell, within which functions of the face reach material
  if (closed_across_gap_) return true;
  return std::abs(motion_.displacement() - start_) > far * cell_ &&
         std::ranges::none_of(closed_, [](int closed) { return closed != 0; });
}

// The force on the wall: minus the forces on the body, without nodes that are about to open, which the wall would have
// to pull. The power is that on the body, Σ F_n w.
WallReaction WallContact::reaction(double t) const {
  WallReaction sum{.name = name_,
                   .displacement = motion_.displacement(),
                   .furthest_behind = motion_.furthest_behind(),
                   .put_back = put_back_};
  double force = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (outward_ * normal_force_[k] > 0) continue;
    sum.normal -= outward_ * normal_force_[k];
    for (std::size_t i = 0; i < sum.shear.size(); ++i) sum.shear[i] -= shear_force_[k][i];
    force += normal_force_[k];
  }
  sum.power = force * motion_.velocity(t);
  return sum;
}

void WallContact::archive(const StateArchive& state) {
  state("closed", closed_);
  std::vector<double> sliding = components_of(sliding_), shear_force = components_of(shear_force_);
  state("sliding", sliding);
  state("gap", gap_);
  state("closed_across_gap", closed_across_gap_);
  state("put_back", put_back_);
  state("started", started_);
  state("displacement_at_start", start_);
  motion_.archive(state);
  state("held", held_);
  state("normal_force", normal_force_);
  state("shear_force", shear_force);
  if (!state.restores()) return;
  sliding_ = in_nodes(sliding);
  shear_force_ = in_nodes(shear_force);
  const std::size_t saved = closed_.size();
  for (const std::size_t size : {sliding_.size(), gap_.size(), held_.size(), normal_force_.size(), shear_force_.size()})
    if (size != saved) throw StateError(fmt::format("of the wall '{}' the numbers of nodes differ", name_));
  if (nodes_.empty()) return;  // of a stage whose first phase is yet to begin, with the nodes of the one before
  // The nodes are those of the restored phase or, before that begins, others.
  closed_.resize(nodes_.size(), 0);
  for (auto* const components : {&sliding_, &shear_force_}) components->resize(nodes_.size(), Along{});
  for (auto* const values : {&gap_, &held_, &normal_force_}) values->resize(nodes_.size(), 0);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k].normal < 0) closed_[k] = 0;
}

double WallContact::square_of_forces() const {
  double sum = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    sum += normal_force_[k] * normal_force_[k];
    for (const double F_t : shear_force_[k]) sum += F_t * F_t;
  }
  return sum;
}

}  // namespace stillpoint
