// The logarithmic strain e = ½ ln b, b = F Fᵀ, with its rate and the change of volume. All of it is computed from H = F
// − I and B = b − I = H + Hᵀ + H Hᵀ, so that a strain far below the rounding of 1 keeps its digits.
#pragma once

#include <stillpoint/dual.hpp>
#include <stillpoint/logarithm.hpp>
#include <stillpoint/tensor.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace stillpoint {

/// A strain e and its rate δe.
template <class Tensor>
struct StrainAndRate {
  Tensor strain, rate;
};

// The strain in the plane, with the mean m = tr₂ b/2 of the eigenvalues b₁, b₂ = m ± r of b, r = ‖dev₂ b‖/√2 and x =
// r/m,
//   ln b = ½ ln(b₁ b₂) I + a/m dev₂ b,   a = artanh(x)/x = 1 + x²/3 + x⁴/5 + …,
// a smooth function of y = x², so that equal eigenvalues are no exception.
template <StressState S>
struct PlaneLogStrain {
  PlaneTensor b, dev;     // dev₂ b
  double m, y, a, slope;  // slope = da/dy
  double plane, zz, J;    // ln det₂F, ln F_zz and ln J, NaN if inside out

  explicit PlaneLogStrain(const PlaneTensor& H) {
    const PlaneTensor F = unit_plus(H), B = left_strain(H);
    b = unit_plus(B);
    m = 1 + (B.xx + B.yy) / 2;
    const double half = (B.xx - B.yy) / 2, plane_ratio = plane_determinant(F);
    dev = {half, b.xy, b.xy, -half, 0};
    y = (half * half + b.xy * b.xy) / (m * m);
    plane = logarithm(plane_ratio, change_of_area(H));
    zz = S == StressState::axisymmetric ? logarithm(F.zz, H.zz) : 0;
    J = plane + zz;
    // (1 + x)/(1 − x) = b₁/b₂ = (b₁/√(b₁ b₂))², which loses no digits as b₂ → 0;  da/dy = (1/(1 − y) − a)/(2 y)
    const double x = std::sqrt(y), b1_over_mean = m * (1 + x) / plane_ratio;
    const double exact = logarithm(b1_over_mean) / x;
    const double one_minus_y = plane_ratio * plane_ratio / (m * m);
    const double exact_slope = (1 / one_minus_y - exact) / (2 * y);
    const bool close = y < close_eigenvalues;
    a = close ? series(y) : exact;
    slope = close ? series_slope(y) : exact_slope;
  }

  PlaneTensor strain_of_one() const { return strain(); }
  PlaneTensor strain() const { return PlaneTensor{plane / 2, 0, 0, plane / 2, zz} + a / (2 * m) * dev; }
  StrainAndRate<PlaneTensor> strain_and_rate(const PlaneTensor& l) const { return {strain(), rate(l)}; }

  auto rate() const {
    return [this](const PlaneTensor& l) { return rate(l); };
  }
  // The strain rate δe for δb = l b + b lᵀ.
  PlaneTensor rate(const PlaneTensor& l) const {
    const PlaneTensor db = l * b + b * transpose(l);
    const double dm = (db.xx + db.yy) / 2, dhalf = (db.xx - db.yy) / 2, dln = (l.xx + l.yy) / 2;
    const double dy = 2 * (dev.xx * dhalf + dev.xy * db.xy) / (m * m) - 2 * y * dm / m;
    const double change = slope * dy / m - a * dm / (m * m);  // change of a/m
    return PlaneTensor{dln, 0, 0, dln, l.zz} + change / 2 * dev +
           a / (2 * m) * PlaneTensor{dhalf, db.xy, db.xy, -dhalf, 0};
  }

  // Below y = 0.01 the sums up to y⁸ are exact to rounding; above it the closed forms lose at most two digits.
  static constexpr double close_eigenvalues = 0.01;
  static double series(double y) {
    double sum = 1.0 / 17;
    for (int n = 7; n >= 0; --n) sum = sum * y + 1.0 / (2 * n + 1);
    return sum;
  }
  static double series_slope(double y) {
    double sum = 9.0 / 19;
    for (int n = 8; n >= 1; --n) sum = sum * y + static_cast<double>(n) / (2 * n + 1);
    return sum;
  }
};

/// The matrix (I + B)^½ − I = B (I + Y)⁻¹, Y = (I + B)^½, for a symmetric B with I + B positive definite, of numbers or
/// Duals.
///
/// Y = (i₁ i₂ − i₃)⁻¹ (i₁ i₃ I + (i₁² − i₂) C − C²) with C = I + B, from the invariants of Y [Hoger and Carlson 1984]:
///
///   i₃ = √I₃,   i₁² = I₁ + 2 i₂,   i₂² = I₂ + 2 i₃ i₁,
///
/// where i₁ is the largest root of f(i₁) = (i₁² − I₁)²/4 − I₂ − 2 i₃ i₁, f' = 2 (i₁ i₂ − i₃) = 2 Π (y_a + y_b) > 0.
/// Substituted into one another, the two equations leave an error of at most i₃/(i₁ i₂) ≤ 1/9, which Newton's method
/// removes; both converge from above, starting at i₁² ≤ 3 I₁. No step asks whether eigenvalues are equal. The product
/// with B keeps the digits of a small B, which Y loses. There is no loop, and the function is always inlined, so that a
/// loop over points is vectorised.
template <class Number>
[[gnu::always_inline]] inline SpaceTensorOf<Number> root_of_unit_plus(const SpaceTensorOf<Number>& B) {
  using std::sqrt;
  const SpaceTensorOf<Number> C = unit_plus(B), C2 = symmetric_product(C, C);
  const Number I1 = trace(C), I2 = (I1 * I1 - trace(C2)) / 2, i3 = sqrt(determinant(C));
  const auto substituted = [&](const Number& i1) { return sqrt(I1 + 2 * sqrt(I2 + 2 * i3 * i1)); };
  const auto newton = [&](const Number& i1) {
    const Number i2 = (i1 * i1 - I1) / 2;
    return i1 - (i2 * i2 - I2 - 2 * i3 * i1) / (2 * (i1 * i2 - i3));
  };
  const Number upper = sqrt(3 * I1);
  const Number i1 = newton(newton(newton(substituted(substituted(upper))))), i2 = (i1 * i1 - I1) / 2;
  const SpaceTensorOf<Number> Y = (1 / (i1 * i2 - i3)) * sphere_plus(i1 * i3, (i1 * i1 - i2) * C - C2);
  return symmetric_product(B, symmetric_inverse(unit_plus(Y)));
}

/// a + b W + c W²
template <class Number>
[[gnu::always_inline]] inline SpaceTensorOf<Number> quadratic(double a, double b, double c,
                                                              const SpaceTensorOf<Number>& W,
                                                              const SpaceTensorOf<Number>& W2) {
  return sphere_plus(a, b * W + c * W2);
}

/// The logarithm of I + X for a symmetric X below a fifth, where the series is short:
///
///   ln(I + X) = 2 artanh Z,   Z = X (2 I + X)⁻¹,   artanh Z = Z (I + W/3 + W²/5 + … + W⁸/17),   W = Z² < 1/80,
///
/// the sum as (1, 1/3, 1/5) + W³ ((1/7, 1/9, 1/11) + W³ (1/13, 1/15, 1/17)) [Paterson and Stockmeyer 1973].
template <class Number>
[[gnu::always_inline]] inline SpaceTensorOf<Number> log_near_unit(const SpaceTensorOf<Number>& X) {
  const SpaceTensorOf<Number> Z = symmetric_product(X, symmetric_inverse(sphere_plus(2.0, X)));
  const SpaceTensorOf<Number> W = symmetric_product(Z, Z), W2 = symmetric_product(W, W), W3 = symmetric_product(W, W2);
  const SpaceTensorOf<Number> last = quadratic(1.0 / 13, 1.0 / 15, 1.0 / 17, W, W2),
                              middle = quadratic(1.0 / 7, 1.0 / 9, 1.0 / 11, W, W2) + symmetric_product(W3, last);
  return 2.0 * symmetric_product(Z, quadratic(1.0, 1.0 / 3, 1.0 / 5, W, W2) + symmetric_product(W3, middle));
}

/// Whether that holds for X: by its Frobenius norm, which no eigenvalue exceeds.
template <class Number>
[[gnu::always_inline]] inline bool is_near_zero(const SpaceTensorOf<Number>& X) {
  constexpr double small = 0.2;
  const auto square = [](const Number& x) { return value_of(x) * value_of(x); };
  return square(X.xx) + square(X.yy) + square(X.zz) + 2 * (square(X.xy) + square(X.yz) + square(X.zx)) < small * small;
}

/// The logarithm ln(I + B), with B as above. Four square roots bring stretches between 0.1 and 10 to within a seventh
/// of 1: ln(I + B) = 2⁴ ln (I + B)^(1/16).
template <class Number>
[[gnu::always_inline]] inline SpaceTensorOf<Number> log_of_unit_plus(const SpaceTensorOf<Number>& B) {
  return 16.0 * log_near_unit(root_of_unit_plus(root_of_unit_plus(root_of_unit_plus(root_of_unit_plus(B)))));
}

/// The same to rounding; where B is small, without a root. It branches, and is for one point at a time.
template <class Number>
SpaceTensorOf<Number> log_of_one(const SpaceTensorOf<Number>& B) {
  return is_near_zero(B) ? log_near_unit(B) : log_of_unit_plus(B);
}

struct SpaceLogStrain {
  SpaceTensor B;
  double J;  // ln J, NaN if inside out

  explicit SpaceLogStrain(const SpaceTensor& H)
      : B(left_strain(H)), J(logarithm(determinant(unit_plus(H)), change_of_volume(H, cofactor(H)))) {}

  SpaceTensor strain() const { return 0.5 * log_of_unit_plus(B); }
  /// The same without a root, where is_near_zero(B).
  SpaceTensor small_strain() const { return 0.5 * log_near_unit(B); }
  /// The strain of one point at a time.
  SpaceTensor strain_of_one() const { return 0.5 * log_of_one(B); }

  /// The strain, and its rate for δb = l b + b lᵀ.
  [[gnu::always_inline]] StrainAndRate<SpaceTensor> strain_and_rate(const SpaceTensor& l) const {
    return halves(log_of_unit_plus(B_and_rate(l)));
  }
  /// The same without a root, where is_near_zero(B).
  [[gnu::always_inline]] StrainAndRate<SpaceTensor> small_strain_and_rate(const SpaceTensor& l) const {
    return halves(log_near_unit(B_and_rate(l)));
  }

  /// The strain rates δe for δb = l b + b lᵀ, for any number of l: Σ_k ∂e/∂b_k δb_k, b_k = b_xx, b_yy, b_zz, b_xy,
  /// b_yz, b_zx, where one evaluation with Duals gives all ∂e/∂b_k.
  class Rate {
   public:
    explicit Rate(const SpaceTensor& B) : b_(unit_plus(B)) {
      using Six = Dual<6>;
      const auto variable = [](double value, std::size_t k) {
        Six b_k(value);
        b_k.derivative[k] = 1;
        return b_k;
      };
      const Six xx = variable(B.xx, 0), yy = variable(B.yy, 1), zz = variable(B.zz, 2), xy = variable(B.xy, 3),
                yz = variable(B.yz, 4), zx = variable(B.zx, 5);
      const SpaceTensorOf<Six> ln = log_of_one(SpaceTensorOf<Six>{xx, xy, zx, xy, yy, yz, zx, yz, zz});
      for (std::size_t k = 0; k < 6; ++k) {
        const auto half = [k](const Six& x) { return x.derivative[k] / 2; };
        slopes_[k] = {half(ln.xx), half(ln.xy), half(ln.xz), half(ln.yx), half(ln.yy),
                      half(ln.yz), half(ln.zx), half(ln.zy), half(ln.zz)};
      }
    }
    SpaceTensor operator()(const SpaceTensor& l) const {
      const SpaceTensor db = l * b_ + b_ * transpose(l);
      return db.xx * slopes_[0] + db.yy * slopes_[1] + db.zz * slopes_[2] + db.xy * slopes_[3] + db.yz * slopes_[4] +
             db.zx * slopes_[5];
    }

   private:
    SpaceTensor b_;
    std::array<SpaceTensor, 6> slopes_;  // ∂e/∂b_k
  };
  Rate rate() const { return Rate(B); }

 private:
  [[gnu::always_inline]] SpaceTensorOf<Directional> B_and_rate(const SpaceTensor& l) const {
    const SpaceTensor half = l + l * B, db = half + transpose(half);
    const Directional xx(B.xx, db.xx), yy(B.yy, db.yy), zz(B.zz, db.zz), xy(B.xy, db.xy), yz(B.yz, db.yz),
        zx(B.zx, db.zx);
    return {xx, xy, zx, xy, yy, yz, zx, yz, zz};
  }
  [[gnu::always_inline]] static StrainAndRate<SpaceTensor> halves(const SpaceTensorOf<Directional>& ln) {
    return {0.5 * SpaceTensor{ln.xx.value, ln.xy.value, ln.xz.value, ln.yx.value, ln.yy.value, ln.yz.value, ln.zx.value,
                              ln.zy.value, ln.zz.value},
            0.5 * SpaceTensor{ln.xx.rate, ln.xy.rate, ln.xz.rate, ln.yx.rate, ln.yy.rate, ln.yz.rate, ln.zx.rate,
                              ln.zy.rate, ln.zz.rate}};
  }
};

/// The logarithmic strain of H = F − I: strain(), rate()(l) for δF = l F, and J = ln det F.
template <StressState S>
using LogStrainOf = std::conditional_t<S == StressState::space, SpaceLogStrain, PlaneLogStrain<S>>;

}  // namespace stillpoint
