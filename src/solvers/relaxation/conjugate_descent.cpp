#include "solvers/relaxation/conjugate_descent.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel_loop.hpp"

namespace stillpoint {

ConjugateDescent::ConjugateDescent(const VectorSpace& vectors, const Mass& mass, bool linear)
    : mass_(mass),
      p_(vectors.make(mass.size())),
      Q_(vectors.make(mass.size())),
      z_(vectors.make(mass.size())),
      way_(vectors.make(mass.size())) {
  if (!linear) memory_.emplace(vectors, mass, memory);
}

void ConjugateDescent::begin(const Vector& Q, const Vector& z, double h) {
  for_each_index(p_.size(), [=, p = p_.span().data(), Q_x = Q_.span().data(), z_x = z_.span().data(),
                             way = way_.span().data(), Q = Q.span().data(), z = z.span().data()](std::size_t i) {
    Q_x[i] = Q[i];
    p[i] = z_x[i] = z[i];
    way[i] = h * z[i];
  });
  slope_ = Q_dot_z_ = pMp_ = dot(Q_, z_);
  h_ = first_h_ = h;
  trials_ = 0;
  if (memory_) memory_->forget();
}

bool ConjugateDescent::evaluated(const Vector& Q, const Vector& z) {
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
    const double alpha = theta * h_;
    const double next = memory_ ? turn_by_memory(theta, Q) : turn_by_beta(theta, Q, z);
    for_each_index(p_.size(), [=, back = alpha - h_, way = way_.span().data(), p = p_.span().data()](std::size_t i) {
      const double p_next = way[i];
      way[i] = back * p[i] + next * p_next;
      p[i] = p_next;
    });
    h_ = next;
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

// way becomes p⁺; Q(x⁺)·p = 0, so that Q(x⁺)·p⁺ = Q(x⁺)·M⁻¹Q(x⁺) and p⁺ᵀMp⁺ = that + β² pᵀMp. Returns h⁺.
double ConjugateDescent::turn_by_beta(double theta, const Vector& Q, const Vector& z) {
  const double with_last = (1 - theta) * Q_dot_z_ + theta * dot(Q, z_);  // Q(x⁺)·M⁻¹Q(x)
  for_each_index(p_.size(), [=, Q_x = Q_.span().data(), z_x = z_.span().data(), Q = Q.span().data(),
                             z = z.span().data()](std::size_t i) {
    Q_x[i] += theta * (Q[i] - Q_x[i]);
    z_x[i] += theta * (z[i] - z_x[i]);
  });
  const double now = dot(Q_, z_), beta = std::max(0.0, (now - with_last) / Q_dot_z_);
  for_each_index(p_.size(), [=, way = way_.span().data(), z_x = z_.span().data(), p = p_.span().data()](std::size_t i) {
    way[i] = z_x[i] + beta * p[i];
  });
  slope_ = Q_dot_z_ = now;
  pMp_ = now + beta * beta * pMp_;
  return theta * h_;
}

// The same by p⁺ = H Q(x⁺).
double ConjugateDescent::turn_by_memory(double theta, const Vector& Q) {
  memory_->remember(h_, p_, Q_, Q);
  for_each_index(p_.size(), [=, Q_x = Q_.span().data(), way = way_.span().data(), Q = Q.span().data()](std::size_t i) {
    way[i] = Q_x[i] += theta * (Q[i] - Q_x[i]);
  });
  memory_->apply(way_);
  slope_ = dot(Q_, way_);
  mass_.apply(way_.span(), z_.span());
  pMp_ = dot(way_, z_);
  return 1;
}

void ConjugateDescent::archive(const StateArchive& state) {
  state("p", p_.span());
  state("Q", Q_.span());
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
