// Conjugate directions with one force evaluation an iteration.
//
//   x, p:  an iterate and its direction;  w = x + h p, the point at which Q is evaluated, h a guess of the step α
//   α = h Q(x)·p/(Q(x)·p − Q(w)·p),  θ = α/h                                  the secant's zero of Q·p
//   x⁺ = w + (α − h) p,  Q(x⁺) = (1 − θ) Q(x) + θ Q(w)                        exact where Q is linear
//   w⁺ = x⁺ + h⁺ p⁺
//
// If Q is linear, p⁺ and h⁺ are those of conjugate gradients preconditioned by M, and so are the iterates, whatever h
// is [Hestenes and Stiefel 1952]:
//
//   p⁺ = M⁻¹Q(x⁺) + β p,  β = max(0, Q(x⁺)·M⁻¹(Q(x⁺) − Q(x))/Q(x)·M⁻¹Q(x)),  h⁺ = α
//
// If Q is not linear, conjugacy is lost faster than the information on K⁻¹ that is in the steps. Then p⁺ = H Q(x⁺) by
// BFGS with limited memory and h⁺ = 1, which with these steps is conjugate gradients as well if Q is linear; and h has
// to be near α, |Q(w)·p| ≤ σ Q(x)·p, or w moves on along the same line. An error in Q(x) is multiplied by (1 − θ) in
// each iteration, so that it fades.
#pragma once

#include <stillpoint/mass.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/vector.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include "solvers/relaxation/descent_spectrum.hpp"
#include "solvers/relaxation/limited_memory.hpp"

namespace stillpoint {

class ConjugateDescent {
 public:
  /// Pairs of steps that are remembered if Q is not linear.
  static constexpr std::size_t memory = 15;

  /// linear: whether Q is linear in u. The mass has to outlive this object.
  ConjugateDescent(const VectorSpace& vectors, const Mass& mass, bool linear);

  /// Begins at w, straight downhill: the first way is h M⁻¹Q with h about 1/ω_max². Q, z = M⁻¹Q: values at w, (n).
  void begin(const Vector& Q, const Vector& z, double h);
  /// Begins at w once the forces have changed in part, as by new multipliers of a contact: what is remembered of K
  /// holds on, and the first way is H Q; without a memory as begin().
  void begin_again(const Vector& Q, const Vector& z, double h);
  /// Notes an evaluation at w, or at a share of the way to it; Q, z = M⁻¹Q: values there, (n).
  void look_at(const Vector& Q, const Vector& z);
  /// Called after look_at() at w, with the same Q and z. False if the descent cannot go on: no positive stiffness along
  /// p, no direction downhill, or no end of the search on its line.
  bool evaluated(const Vector& Q, const Vector& z);
  /// The displacement from this w to the next one, (n).
  ConstVec way() const { return way_.span(); }
  /// pᵀKp/pᵀMp of the last line [1/s²].
  double quotient() const { return quotient_; }
  /// ω₁² of the modes met so far [1/s²], if Q is linear and the estimate has settled.
  std::optional<double> lowest() const {
    // If κ(M⁻¹K) is small, the descent is over in a few steps and no value stays near a wrong one for long.
    constexpr double usual = 0.02, of_few_steps = 0.1;
    return memory_ ? std::nullopt : spectrum_.lowest(mass_.has_product() ? usual : of_few_steps);
  }
  /// ‖Q‖ at the last evaluation or beginning [N].
  double unbalanced_force() const { return std::sqrt(Q_dot_.Q); }
  /// √(QᵀM⁻¹Q) at the same place [N/√kg].
  double unbalanced() const { return std::sqrt(std::max(0.0, Q_dot_.z)); }

  void archive(const StateArchive& state);

 private:
  struct Products {  // products of Q(w) with p, z_x = M⁻¹Q(x) (only if Q is linear), z and Q
    double p, z_x, z, Q;
  };
  void move_Q(double theta, const Vector& Q);
  void turn_by_beta(double theta, const Vector& Q, const Vector& z);
  void turn_by_memory(double theta, const Vector& Q);

  const Mass& mass_;
  std::optional<LimitedMemory> memory_;  // if Q is not linear
  Vector p_, way_;                       // p, w⁺ − w, (n)
  Vector z_;                             // M⁻¹Q(x), or work space with a memory, (n)
  std::optional<Vector> Q_;              // Q(x), with a memory or without products with M, (n)
  double h_ = 0, first_h_ = 0;
  double slope_ = 0;          // Q(x)·p
  double Q_dot_z_ = 0;        // Q(x)·M⁻¹Q(x), if Q is linear
  double Q_dot_z_error_ = 0;  // bound of its rounding error
  double pMp_ = 0;            // pᵀMp
  double quotient_ = 0;
  DescentSpectrum spectrum_;
  Products Q_dot_{};
  int trials_ = 0;  // evaluations on this line
};

}  // namespace stillpoint
