#include "solvers/relaxation/conjugate_descent.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel_loop.hpp"
#include "linalg/vector_operations.hpp"

namespace stillpoint {

ConjugateDescent::ConjugateDescent(const VectorSpace& vectors, const Mass& mass, bool linear)
    : mass_(mass), p_(vectors.make(mass.size())), z_(vectors.make(mass.size())), way_(vectors.make(mass.size())) {
  if (linear) return;
  memory_.emplace(vectors, mass, memory);
  Q_.emplace(vectors.make(mass.size()));
}

void ConjugateDescent::begin(const Vector& Q, const Vector& z, double h) {
  for_each_index(p_.size(), [=, p = p_.span().data(), z_x = z_.span().data(), way = way_.span().data(),
                             z = z.span().data()](std::size_t i) {
    p[i] = z_x[i] = z[i];
    way[i] = h * z[i];
  });
  if (Q_) copy(Q, *Q_);
  slope_ = Q_dot_z_ = pMp_ = dot(Q, z);
  h_ = first_h_ = h;
  trials_ = 0;
  if (memory_) memory_->forget();
}

bool ConjugateDescent::evaluated(const Vector& Q, const Vector& z, double Q_dot_z) {
  constexpr double sigma = 0.8, rounding = 1e-13;  // of pᵀKp, beside ω_max²
  constexpr int most_trials = 8;
  if (slope_ == 0) {  // it was in balance to the last bit, or thought so
    begin(Q, z, first_h_);
    return true;
  }
  const double slope = dot(Q, p_), fall = slope_ - slope;  // Q(w)·p, h pᵀKp
  quotient_ = fall / (h_ * pMp_);
  if (!(quotient_ * first_h_ > rounding)) return false;
  const double theta = slope_ / fall;
  // How far a secant reaches. Where Q is linear that is a matter of rounding alone, which may be all there is left.
  const double reach = memory_ ? 10 : 1e3;
  if (memory_ ? std::abs(slope) <= sigma * slope_ : theta <= reach) {
    memory_ ? turn_by_memory(theta, Q) : turn_by_beta(theta, Q, z, Q_dot_z);
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

// Q(x⁺)·M⁻¹Q(x) and Q(x⁺)·M⁻¹Q(x⁺) from what is known at x and at w. Q(x⁺)·p = 0, so that Q(x⁺)·p⁺ is the latter, and
// p⁺ᵀMp⁺ = that + β² pᵀMp.
void ConjugateDescent::turn_by_beta(double theta, const Vector& Q, const Vector& z, double Q_dot_z) {
  const double Q_dot_z_x = dot(Q, z_), left = 1 - theta;
  const double with_last = left * Q_dot_z_ + theta * Q_dot_z_x;
  const double now = left * left * Q_dot_z_ + 2 * theta * left * Q_dot_z_x + theta * theta * Q_dot_z;
  const double beta = std::max(0.0, (now - with_last) / Q_dot_z_), alpha = theta * h_;
  for_each_index(p_.size(), [=, back = alpha - h_, z_x = z_.span().data(), z = z.span().data(), p = p_.span().data(),
                             way = way_.span().data()](std::size_t i) {
    z_x[i] += theta * (z[i] - z_x[i]);
    const double p_next = z_x[i] + beta * p[i];
    way[i] = back * p[i] + alpha * p_next;
    p[i] = p_next;
  });
  slope_ = Q_dot_z_ = now;
  pMp_ = now + beta * beta * pMp_;
  h_ = alpha;
}

// The same by p⁺ = H Q(x⁺).
void ConjugateDescent::turn_by_memory(double theta, const Vector& Q) {
  memory_->remember(h_, p_, *Q_, Q);
  for_each_index(p_.size(), [=, Q_x = Q_->span().data(), way = way_.span().data(), Q = Q.span().data()](std::size_t i) {
    way[i] = Q_x[i] += theta * (Q[i] - Q_x[i]);
  });
  memory_->apply(way_);
  slope_ = dot(*Q_, way_);
  mass_.apply(way_.span(), z_.span());
  pMp_ = dot(way_, z_);
  const double back = theta * h_ - h_;
  for_each_index(p_.size(), [=, way = way_.span().data(), p = p_.span().data()](std::size_t i) {
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
  state("pMp", pMp_);
  state("quotient", quotient_);
  state("trials", trials_);
  if (memory_) memory_->archive(state.part("memory"));
}

}  // namespace stillpoint
