// The principal values of a deviator, sorted, and the tensor that has others in their place along the same axes:
// without eigenvectors, trigonometric functions or a branch, and to rounding for equal and nearly equal values.
#pragma once

#include <stillpoint/stress_increment.hpp>

#include <array>
#include <cmath>

namespace stillpoint {

/// Principal values, the largest first.
template <class Number>
using Principal = std::array<Number, 3>;

/// A select: both are computed, without a branch, so that a loop over points is vectorised. A derivative is that of the
/// one taken.
template <class Number>
[[gnu::always_inline]] inline Number either(bool first, Number a, Number b) {
  return first ? a : b;
}
template <class Number>
[[gnu::always_inline]] inline Number larger(const Number& a, const Number& b) {
  return either(a > b, a, b);
}
template <class Number>
[[gnu::always_inline]] inline Number smaller(const Number& a, const Number& b) {
  return either(b > a, a, b);
}

/// A product of stresses [Pa²] beside which none is left: quotients stay finite where both terms vanish, and so do
/// cubes of its root.
inline constexpr double vanishing_product = 1e-180;

/// In the plane two principal values are s_m ± r, r = |((s_xx − s_yy)/2, s_xy)|, and the third is s_zz = −2 s_m.
template <class Number>
class PlanePrincipal {
 public:
  [[gnu::always_inline]] explicit PlanePrincipal(const PlaneDeviator<Number>& s)
      : half_(s.half), shear_(s.shear), across_(s.zz) {  // one by one: a copied aggregate is not vectorised
    using std::sqrt;
    radius_ = sqrt(s.half * s.half + s.shear * s.shear + vanishing_product);
    upper_ = radius_ - s.zz / 2;
    lower_ = -radius_ - s.zz / 2;
  }
  [[gnu::always_inline]] Principal<Number> values() const {
    return {larger(upper_, across_), larger(lower_, smaller(upper_, across_)), smaller(lower_, across_)};
  }
  /// The deviator with the values y − mean, whose sum is 0, in place of values().
  [[gnu::always_inline]] PlaneDeviator<Number> with(const Principal<Number>& y, const Number& mean) const {
    const bool across_is_largest = !(upper_ > across_), across_is_least = !(across_ > lower_);
    const Number across = either(across_is_largest, y[0], either(across_is_least, y[2], y[1]));
    const Number upper = either(across_is_largest, y[1], y[0]);
    const Number lower = either(across_is_least & !across_is_largest, y[1], y[2]);
    const Number share = (upper - lower) / (2 * radius_);
    return {share * half_, share * shear_, across - mean};
  }

 private:
  Number half_, shear_, across_;
  Number radius_, upper_, lower_;
};

/// In space, with J₂ = s : s/2, J₃ = det s and cos 3θ = (3 √3/2) J₃/J₂^{3/2}, the principal value that is farthest from
/// the others is x = ± 2 √(J₂/3) t with the sign of J₃, where 4 t³ − 3 t = |cos 3θ|, √3/2 ≤ t ≤ 1. With its projector
///
///   N = (s² + x s + (x² − J₂) I)/(3 x² − J₂),   s = x N − x/2 (I − N) + D,
///
/// the other two are −x/2 ± δ, δ² = D : D/2. D comes from the tensor and not from a root of the cubic, so that δ has
/// the error of s however small it is. Other values y_x, y_m ± y_δ along the same axes make y_m I + (y_x − y_m) N +
/// (y_δ/δ) D.
template <class Number>
class SpacePrincipal {
  using T = SpaceTensorOf<Number>;

 public:
  [[gnu::always_inline]] explicit SpacePrincipal(const T& s) {
    using std::sqrt;
    // Cayley and Hamilton: s³ = J₂ s + J₃ I
    const Number J2 = second_invariant(s) + vanishing_product, root = sqrt(J2 / 3);
    const Number J3 =
        s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.zx) + s.zx * (s.xy * s.yz - s.yy * s.zx);
    const Number cosine = J3 / (2 * root * root * root);
    lone_is_largest_ = !(Number(0) > cosine);
    const Number t = largest_root(either(lone_is_largest_, cosine, Number(-cosine))), lone = 2 * root * t;
    x_ = either(lone_is_largest_, lone, Number(-lone));

    const Number x2 = x_ * x_, over = 1 / (3 * x2 - J2), c = x2 - J2;
    const Number xx = s.xx * s.xx + s.xy * s.xy + s.zx * s.zx, yy = s.xy * s.xy + s.yy * s.yy + s.yz * s.yz,
                 zz = s.zx * s.zx + s.yz * s.yz + s.zz * s.zz;
    const Number xy = s.xx * s.xy + s.xy * s.yy + s.zx * s.yz, yz = s.xy * s.zx + s.yy * s.yz + s.yz * s.zz,
                 zx = s.xx * s.zx + s.xy * s.yz + s.zx * s.zz;
    N_ = symmetric(over * (xx + x_ * s.xx + c), over * (yy + x_ * s.yy + c), over * (zz + x_ * s.zz + c),
                   over * (xy + x_ * s.xy), over * (yz + x_ * s.yz), over * (zx + x_ * s.zx));
    const Number half = x_ / 2, f = 1.5 * x_;
    D_ = symmetric(s.xx + half - f * N_.xx, s.yy + half - f * N_.yy, s.zz + half - f * N_.zz, s.xy - f * N_.xy,
                   s.yz - f * N_.yz, s.zx - f * N_.zx);
    delta_ = sqrt(second_invariant(D_) + vanishing_product);
  }
  [[gnu::always_inline]] Principal<Number> values() const {
    const Number upper = delta_ - x_ / 2, lower = -delta_ - x_ / 2;
    return {either(lone_is_largest_, x_, upper), either(lone_is_largest_, upper, lower),
            either(lone_is_largest_, lower, x_)};
  }
  [[gnu::always_inline]] T with(const Principal<Number>& y, const Number& mean) const {
    const Number lone = either(lone_is_largest_, y[0], y[2]), upper = either(lone_is_largest_, y[1], y[0]),
                 lower = either(lone_is_largest_, y[2], y[1]);
    const Number middle = (upper + lower) / 2, along = lone - middle, share = (upper - lower) / (2 * delta_);
    const Number m = middle - mean;
    return symmetric(m + along * N_.xx + share * D_.xx, m + along * N_.yy + share * D_.yy,
                     m + along * N_.zz + share * D_.zz, along * N_.xy + share * D_.xy, along * N_.yz + share * D_.yz,
                     along * N_.zx + share * D_.zx);
  }

 private:
  // The root of 4 t³ − 3 t = c in √3/2 ≤ t ≤ 1: a parabola that is off by at most 8e-4, then Newton's method, whose
  // third step is exact to rounding.
  [[gnu::always_inline]] static Number largest_root(const Number& c) {
    constexpr double root_3_half = 0.86602540378443864676;
    const auto newton = [&](const Number& t) { return t - ((4 * t * t - 3) * t - c) / (12 * t * t - 3); };
    return newton(newton(newton(root_3_half + c * (0.16 - (0.16 - (1 - root_3_half)) * c))));
  }
  [[gnu::always_inline]] static T symmetric(const Number& xx, const Number& yy, const Number& zz, const Number& xy,
                                            const Number& yz, const Number& zx) {
    return {xx, xy, zx, xy, yy, yz, zx, yz, zz};
  }

  bool lone_is_largest_;
  Number x_, delta_;
  T N_, D_;
};

template <StressState S, class Number>
using PrincipalOf = std::conditional_t<S == StressState::space, SpacePrincipal<Number>, PlanePrincipal<Number>>;

}  // namespace stillpoint
