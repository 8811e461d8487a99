// Conjugate directions in one force evaluation an iteration.
//
//   x, p:  an iterate and its direction;  w = x + h p, where Q is evaluated, h a guess of the step α
//   α = h Q(x)·p/(Q(x)·p − Q(w)·p),  θ = α/h                                  the secant's zero of Q·p
//   x⁺ = w + (α − h) p,  Q(x⁺) = (1 − θ) Q(x) + θ Q(w)                        exact where Q is linear
//   w⁺ = x⁺ + h⁺ p⁺
//
// Where Q is linear p⁺ and h⁺ are those of conjugate gradients, preconditioned by M, and so are the iterates, whatever
// the h [Hestenes and Stiefel 1952]:
//
//   p⁺ = M⁻¹Q(x⁺) + β p,  β = max(0, Q(x⁺)·M⁻¹(Q(x⁺) − Q(x))/Q(x)·M⁻¹Q(x)),  h⁺ = α
//
// Where it is not, conjugacy is lost faster than what steps tell of K⁻¹: p⁺ = H Q(x⁺) by BFGS with limited memory,
// h⁺ = 1, which with such steps is conjugate gradients as well if Q is linear; and h has to be near α,
// |Q(w)·p| ≤ σ Q(x)·p, or w moves on along the same line. As what was not exact in Q(x) is taken (1 − θ) times, it
// fades.
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
  /// Pairs of steps that are remembered where Q is not linear.
  static constexpr std::size_t memory = 15;

  /// linear: whether Q is. The mass outlives this.
  ConjugateDescent(const VectorSpace& vectors, const Mass& mass, bool linear);

  /// Begins at w: straight down, by h M⁻¹Q at first, h about 1/ω_max². Q, z = M⁻¹Q at w, (n).
  void begin(const Vector& Q, const Vector& z, double h);
  /// An evaluation at w, or where a share of the way leads; Q, z = M⁻¹Q there.
  void look_at(const Vector& Q, const Vector& z);
  /// After one at w; the same Q, z. False if there is no way on: no positive stiffness along p, no direction
  /// downhill, or no end of the search on its line.
  bool evaluated(const Vector& Q, const Vector& z);
  /// From w to the next one, (n).
  ConstVec way() const { return way_.span(); }
  /// pᵀKp/pᵀMp of the last line [1/s²].
  double quotient() const { return quotient_; }
  /// ω₁² of the motions that it has met [1/s²], where Q is linear and it shows.
  std::optional<double> lowest() const {
    // Where M⁻¹K has a small κ the descent is over in a few steps, and no value stays near a wrong one for long.
    constexpr double usual = 0.02, of_few_steps = 0.1;
    return memory_ ? std::nullopt : spectrum_.lowest(mass_.has_product() ? usual : of_few_steps);
  }
  /// ‖Q‖ where it was last evaluated or begun [N].
  double unbalanced_force() const { return std::sqrt(Q_dot_.Q); }
  /// √(QᵀM⁻¹Q) there [N/√kg].
  double unbalanced() const { return std::sqrt(std::max(0.0, Q_dot_.z)); }

  void archive(const StateArchive& state);

 private:
  struct Products {  // of Q(w) with each of these; with z_x = M⁻¹Q(x) only where Q is linear
    double p, z_x, z, Q;
  };
  void move_Q(double theta, const Vector& Q);
  void turn_by_beta(double theta, const Vector& Q, const Vector& z);
  void turn_by_memory(double theta, const Vector& Q);

  const Mass& mass_;
  std::optional<LimitedMemory> memory_;  // if Q is not linear
  Vector p_, way_;                       // p, w⁺ − w, (n)
  Vector z_;                             // M⁻¹Q(x), or work with a memory, (n)
  std::optional<Vector> Q_;              // Q(x), with a memory or without products with M, (n)
  double h_ = 0, first_h_ = 0;
  double slope_ = 0;          // Q(x)·p
  double Q_dot_z_ = 0;        // Q(x)·M⁻¹Q(x), where Q is linear,
  double Q_dot_z_error_ = 0;  // and what rounding may have made of it
  double pMp_ = 0;            // pᵀMp
  double quotient_ = 0;
  DescentSpectrum spectrum_;
  Products Q_dot_{};
  int trials_ = 0;  // on this line
};

}  // namespace stillpoint
