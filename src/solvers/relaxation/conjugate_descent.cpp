#include "solvers/relaxation/conjugate_descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel_loop.hpp"
#include "linalg/vector_operations.hpp"

namespace stillpoint {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

ConjugateDescent::ConjugateDescent(const VectorSpace& vectors, const Mass& mass, bool linear)
    : mass_(mass), p_(vectors.make(mass.size())), way_(vectors.make(mass.size())), z_(vectors.make(mass.size())) {
  if (!linear || !mass.has_product()) Q_ = vectors.make(mass.size());
  if (!linear) memory_.emplace(vectors, mass, memory);
}

void ConjugateDescent::begin(const Vector& Q, const Vector& z, double h) {
  for_each_index(p_.size(), [=, p = p_.span().data(), z_x = z_.span().data(), way = way_.span().data(),
                             z = z.span().data()](std::size_t i) {
    p[i] = z_x[i] = z[i];
    way[i] = h * z[i];
  });
  if (Q_) copy(Q, *Q_);
  const auto [Q_dot_z, Q_dot_Q] = dots(Q, z, Q);
  Q_dot_ = {.p = Q_dot_z, .z_x = Q_dot_z, .z = Q_dot_z, .Q = Q_dot_Q};
  slope_ = Q_dot_z_ = pMp_ = Q_dot_.z;
  Q_dot_z_error_ = epsilon * Q_dot_.z;
  h_ = first_h_ = h;
  trials_ = 0;
  spectrum_.begin();
  if (memory_) memory_->forget();
}

void ConjugateDescent::begin_again(const Vector& Q, const Vector& z, double h) {
  if (!memory_ || memory_->empty()) return begin(Q, z, h);
  copy(Q, *Q_);
  copy(Q, way_);
  memory_->apply(way_);
  const double slope = dot(Q, way_);
  if (!(slope > 0)) return begin(Q, z, h);
  const auto [Q_dot_z, Q_dot_Q] = dots(Q, z, Q);
  Q_dot_ = {.p = slope, .z_x = Q_dot_z, .z = Q_dot_z, .Q = Q_dot_Q};
  copy(way_, p_);
  pMp_ = slope;
  if (mass_.has_product()) {
    mass_.apply(p_.span(), z_.span());
    pMp_ = dot(p_, z_);
  }
  slope_ = slope;
  h_ = 1;
  first_h_ = h;
  trials_ = 0;
}

void ConjugateDescent::look_at(const Vector& Q, const Vector& z) {
  if (memory_) {
    const auto [p, z_w, Q_w] = dots(Q, p_, z, Q);
    Q_dot_ = {.p = p, .z_x = 0, .z = z_w, .Q = Q_w};
  } else {
    const auto [p, z_x, z_w, Q_w] = dots(Q, p_, z_, z, Q);
    Q_dot_ = {.p = p, .z_x = z_x, .z = z_w, .Q = Q_w};
  }
}

bool ConjugateDescent::evaluated(const Vector& Q, const Vector& z) {
  constexpr double sigma = 0.8, rounding = 1e-13;  // rounding: of pᵀKp/pᵀMp, relative to ω_max²
  constexpr int most_trials = 8;
  if (slope_ == 0) {  // the last state was in balance to the last bit, or seemed so
    begin(Q, z, first_h_);
    return true;
  }
  const double slope = Q_dot_.p, fall = slope_ - slope;  // Q(w)·p, h pᵀKp
  quotient_ = fall / (h_ * pMp_);
  if (!(quotient_ * first_h_ > rounding)) return false;
  const double theta = slope_ / fall;
  // The farthest secant that is followed. If Q is linear, a limit is needed against rounding alone, when nothing else
  // is left.
  const double reach = memory_ ? 10 : 1e3;
  if (memory_ ? std::abs(slope) <= sigma * slope_ : theta <= reach) {
    if (memory_) {
      turn_by_memory(theta, Q);
    } else {
      turn_by_beta(theta, Q, z);
    }
    trials_ = 0;
    return slope_ >= 0;  // also if it is not a number
  }
  if (++trials_ == most_trials) return false;
  const double h = h_ * std::clamp(theta, 1 / reach, reach);
  for_each_index(p_.size(), [step = h - h_, way = way_.span().data(), p = p_.span().data()](std::size_t i) {
    way[i] = step * p[i];
  });
  h_ = h;
  return true;
}

// Q_ becomes Q(x⁺).
void ConjugateDescent::move_Q(double theta, const Vector& Q) {
  for_each_index(Q_->size(), [=, Q_x = Q_->span().data(), Q_w = Q.span().data()](std::size_t i) {
    Q_x[i] += theta * (Q_w[i] - Q_x[i]);
  });
}

// Q(x⁺)·p = 0, so that Q(x⁺)·p⁺ = Q(x⁺)·M⁻¹Q(x⁺) and p⁺ᵀMp⁺ = Q(x⁺)·M⁻¹Q(x⁺) + β² pᵀMp. As M is symmetric, all of them
// follow from products with Q(w):
//
//   Q(x⁺)·M⁻¹Q(x) = (1 − θ) Q(x)·M⁻¹Q(x) + θ Q(w)·M⁻¹Q(x)
//   Q(x⁺)·M⁻¹Q(x⁺) = (1 − θ)² Q(x)·M⁻¹Q(x) + 2 θ (1 − θ) Q(w)·M⁻¹Q(x) + θ² Q(w)·M⁻¹Q(w)
//
// The second is summed anew once too many of its digits are lost.
void ConjugateDescent::turn_by_beta(double theta, const Vector& Q, const Vector& z) {
  constexpr double most_lost = 1e-12;
  const double rest = 1 - theta;
  const double of_x = rest * rest * Q_dot_z_, mixed = 2 * theta * rest * Q_dot_.z_x, of_w = theta * theta * Q_dot_.z;
  double now = of_x + mixed + of_w;
  Q_dot_z_error_ = rest * rest * Q_dot_z_error_ + epsilon * (of_x + std::abs(mixed) + of_w);
  const bool is_lost = !(Q_dot_z_error_ <= most_lost * now);
  const auto move_z = [=, z_x = z_.span().data(), z = z.span().data()](std::size_t i) {
    return z_x[i] += theta * (z[i] - z_x[i]);
  };
  if (Q_) move_Q(theta, Q);
  if (is_lost) {
    for_each_index(p_.size(), move_z);
    if (!Q_) mass_.apply(z_.span(), way_.span());
    now = dot(z_, Q_ ? *Q_ : way_);
    Q_dot_z_error_ = epsilon * now;
  }
  const double with_last = rest * Q_dot_z_ + theta * Q_dot_.z_x;
  const double beta = std::max(0.0, (now - with_last) / Q_dot_z_), alpha = theta * h_;
  const auto turn = [=, back = alpha - h_, way = way_.span().data(), p = p_.span().data()](std::size_t i, double z_i) {
    const double p_next = z_i + beta * p[i];
    way[i] = back * p[i] + alpha * p_next;
    p[i] = p_next;
  };
  if (is_lost) {
    for_each_index(p_.size(), [=, z_x = z_.span().data()](std::size_t i) { turn(i, z_x[i]); });
  } else {
    for_each_index(p_.size(), [=](std::size_t i) { turn(i, move_z(i)); });
  }
  spectrum_.add(alpha, beta);
  slope_ = Q_dot_z_ = now;
  pMp_ = now + beta * beta * pMp_;
  h_ = alpha;
}

// Turns p by the memory: p⁺ = H Q(x⁺), with the step 1.
void ConjugateDescent::turn_by_memory(double theta, const Vector& Q) {
  memory_->remember(h_, p_, *Q_, Q);
  for_each_index(p_.size(), [=, Q_x = Q_->span().data(), way = way_.span().data(), Q = Q.span().data()](std::size_t i) {
    way[i] = Q_x[i] += theta * (Q[i] - Q_x[i]);
  });
  memory_->apply(way_);
  slope_ = dot(*Q_, way_);
  if (mass_.has_product()) {
    mass_.apply(way_.span(), z_.span());
    pMp_ = dot(way_, z_);
  } else {
    pMp_ = slope_;  // M as if p were M⁻¹Q: M only gives the scale of K
  }
  for_each_index(p_.size(), [back = (theta - 1) * h_, way = way_.span().data(), p = p_.span().data()](std::size_t i) {
    const double p_next = way[i];
    way[i] = back * p[i] + p_next;
    p[i] = p_next;
  });
  h_ = 1;
}

void ConjugateDescent::archive(const StateArchive& state) {
  state("p", p_.span());
  if (Q_) state("Q", Q_->span());
  state("z", z_.span());
  state("way", way_.span());
  state("h", h_);
  state("first_h", first_h_);
  state("slope", slope_);
  state("Q_dot_z", Q_dot_z_);
  state("Q_dot_z_error", Q_dot_z_error_);
  state("pMp", pMp_);
  state("quotient", quotient_);
  state("Q_dot_z_w", Q_dot_.z);
  state("Q_dot_Q", Q_dot_.Q);
  state("trials", trials_);
  if (memory_) {
    memory_->archive(state.part("memory"));
  } else {
    spectrum_.archive(state.part("spectrum"));
  }
}

}  // namespace stillpoint
