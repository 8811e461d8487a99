// An increment of deformation for laws that store the Cauchy stress: the elastic trial, turned with the material, and
// the nominal stress at the end.
//
// With f = I + H at the end of the increment and g = f − dH/2 half-way [Hughes and Winget 1980],
//   l = dH g⁻¹ = d + w,   σ_trial = R σ Rᵀ + R½ (C : d) R½ᵀ,   R½ R½ = R the rotation by 2 arctan(w/2),
// so that a rotation turns the stress exactly, in any number of increments, and any other path is of second order.
#pragma once

#include <stillpoint/tensor.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace stillpoint {

template <StressState S, class Number>
using GradientOf = std::array<Number, gradient_components(S)>;

/// A deviator in the plane: half the difference of the normal stresses, the shear stress, and that across the plane.
template <class Number>
struct PlaneDeviator {
  Number half, shear, zz;  // (s_xx − s_yy)/2, s_xy, s_zz
};
template <class Number>
constexpr PlaneDeviator<Number> operator*(const Number& a, const PlaneDeviator<Number>& s) {
  return {a * s.half, a * s.shear, a * s.zz};
}
/// J₂ = s : s/2, and its bilinear form a : b/2.
template <class Number>
constexpr Number second_invariant(const PlaneDeviator<Number>& s) {
  return s.half * s.half + s.shear * s.shear + 0.75 * (s.zz * s.zz);
}
template <class Number>
constexpr Number second_invariant(const SpaceTensorOf<Number>& s) {
  return (s.xx * s.xx + s.yy * s.yy + s.zz * s.zz) / 2 + (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
}
template <class Number>
constexpr Number second_invariant(const PlaneDeviator<Number>& a, const PlaneDeviator<Number>& b) {
  return a.half * b.half + a.shear * b.shear + 0.75 * (a.zz * b.zz);
}
template <class Number>
constexpr Number second_invariant(const SpaceTensorOf<Number>& a, const SpaceTensorOf<Number>& b) {
  return (a.xx * b.xx + a.yy * b.yy + a.zz * b.zz) / 2 + (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}

template <StressState S, class Number>
using DeviatorOf = std::conditional_t<S == StressState::space, SpaceTensorOf<Number>, PlaneDeviator<Number>>;

/// The deviator of a stress with the mean p.
template <StressState S>
constexpr DeviatorOf<S, double> deviator_of(const Stress<S>& sigma, double p) {
  if constexpr (S == StressState::space) {
    return {sigma[0] - p, sigma[3], sigma[5], sigma[3], sigma[1] - p, sigma[4], sigma[5], sigma[4], sigma[2] - p};
  } else {
    return {(sigma[0] - sigma[1]) / 2, sigma[3], sigma[2] - p};
  }
}

/// The stress p I + s in the order of components of a Stress.
template <class Number>
constexpr std::array<Number, 4> stress_of(const Number& p, const PlaneDeviator<Number>& s) {
  return {p - s.zz / 2 + s.half, p - s.zz / 2 - s.half, p + s.zz, s.shear};
}
template <class Number>
constexpr std::array<Number, 6> stress_of(const Number& p, const SpaceTensorOf<Number>& s) {
  return {p + s.xx, p + s.yy, p + s.zz, s.xy, s.yz, s.zx};
}

/// The hoop increment d_θθ.
template <StressState S, class Number>
constexpr Number hoop_increment(const GradientOf<S, Number>& H, const GradientOf<S, Number>& dH) {
  if constexpr (S == StressState::axisymmetric) {
    return dH[4] / (1 + H[4] - dH[4] / 2);
  } else {
    return 0;
  }
}

/// The stretch d and the rotation R of an increment. Number: double, or a Dual, which carries derivatives by H and dH.
template <StressState S, class Number>
class PlaneIncrement {
 public:
  [[gnu::always_inline]] PlaneIncrement(const GradientOf<S, Number>& H, const GradientOf<S, Number>& dH) {
    const Number gxx = 1 + H[0] - dH[0] / 2, gxy = H[1] - dH[1] / 2, gyx = H[2] - dH[2] / 2, gyy = 1 + H[3] - dH[3] / 2;
    det_g = gxx * gyy - gxy * gyx;
    const Number Lxx = dH[0] * gyy - dH[1] * gyx, Lxy = dH[1] * gxx - dH[0] * gxy;  // det g l
    const Number Lyx = dH[2] * gyy - dH[3] * gyx, Lyy = dH[3] * gxx - dH[2] * gxy;

    // The rotation by θ, tan(θ/2) = w_yx/2 = q/det g; a tensor turns by 2θ in (half difference, shear), by θ under R½.
    // A single division serves 1/det g and 1/(det²g + q²).
    const Number q = 0.25 * (Lyx - Lxy), det2 = det_g * det_g, q2 = q * q, sum = det2 + q2;
    const Number once = 1 / (det_g * sum), by_det = once * sum, by_sum = once * det_g;
    dzz_ = hoop_increment<S, Number>(H, dH);
    volume_change = by_det * (Lxx + Lyy) + dzz_;
    difference_ = by_det * (Lxx - Lyy);
    shear_ = by_det * (Lxy + Lyx);
    cos_ = (det2 - q2) * by_sum;
    sin_ = 2 * q * (det_g * by_sum);
    cos2_ = 1 - 2 * sin_ * sin_;
    sin2_ = 2 * sin_ * cos_;
  }
  /// R s Rᵀ, with the deviator s of a stress σ with the mean p.
  [[gnu::always_inline]] PlaneDeviator<Number> turned_stress(const Stress<S>& sigma, double p) const {
    const double half = (sigma[0] - sigma[1]) / 2, shear = sigma[3];
    return {cos2_ * half - sin2_ * shear, sin2_ * half + cos2_ * shear, sigma[2] - p};
  }
  /// R½ 2 G dev d R½ᵀ.
  template <class Modulus>
  [[gnu::always_inline]] PlaneDeviator<Number> turned_stretch(const Modulus& G) const {
    const Number half = G * difference_, shear = G * shear_;
    return {cos_ * half - sin_ * shear, sin_ * half + cos_ * shear, 2 * G * (dzz_ - volume_change * (1.0 / 3))};
  }
  /// The sum of both.
  template <class Modulus>
  [[gnu::always_inline]] PlaneDeviator<Number> turned_sum(const Stress<S>& sigma, double p, const Modulus& G) const {
    const PlaneDeviator<Number> s = turned_stress(sigma, p), d = turned_stretch(G);
    return {s.half + d.half, s.shear + d.shear, s.zz + d.zz};
  }

  /// R, in three dimensions.
  [[gnu::always_inline]] SpaceTensorOf<Number> rotation() const {
    const Number none = 0, one = 1;
    return {cos_, -sin_, none, sin_, cos_, none, none, none, one};
  }

  Number volume_change;  // tr d
  Number det_g;

 private:
  Number difference_, shear_, dzz_;  // d_xx − d_yy, 2 d_xy, d_zz
  Number cos_, sin_, cos2_, sin2_;
};

template <class Number>
class SpaceIncrement {
  using T = SpaceTensorOf<Number>;

 public:
  [[gnu::always_inline]] SpaceIncrement(const std::array<Number, 9>& H, const std::array<Number, 9>& dH) {
    const T f{1 + H[0], H[1], H[2], H[3], 1 + H[4], H[5], H[6], H[7], 1 + H[8]};
    const T df{dH[0], dH[1], dH[2], dH[3], dH[4], dH[5], dH[6], dH[7], dH[8]};

    const T g = f - 0.5 * df, cof_g = cofactor(g);
    det_g = g.xx * cof_g.xx + g.xy * cof_g.xy + g.xz * cof_g.xz;
    const T L = df * transpose(cof_g);  // det g l

    // With a the axial vector of w/2 and A x = a × x: R = I + 2/(1 + a²) (A + A²) turns by 2 arctan |a|, and
    //   R½ = (I + A + a aᵀ/(1 + s))/s,   s = √(1 + a²),
    // by arctan |a|. With S = s det g and det g a a single division serves 1/det g, 1/S and 1/(S (det g + S)).
    using std::sqrt;
    const Number ax = 0.25 * (L.zy - L.yz), ay = 0.25 * (L.xz - L.zx), az = 0.25 * (L.yx - L.xy);
    const Number S = sqrt(det_g * det_g + (ax * ax + ay * ay + az * az)), sum = det_g + S, product = S * sum;
    const Number once = 1 / (det_g * product), by_product = once * det_g, by_S = by_product * sum;
    by_det_ = once * product;
    const Number x = by_S * ax, y = by_S * ay, z = by_S * az, one = by_S * det_g;
    const Number cx = by_product * ax, cy = by_product * ay, cz = by_product * az;
    R_half_ = T{one + cx * ax, cx * ay - z, cz * ax + y, cx * ay + z,  one + cy * ay,
                cy * az - x,   cz * ax - y, cy * az + x, one + cz * az};

    xx_ = L.xx;
    yy_ = L.yy;
    zz_ = L.zz;
    xy_ = L.xy + L.yx;
    yz_ = L.yz + L.zy;
    zx_ = L.zx + L.xz;
    volume_change = by_det_ * (xx_ + yy_ + zz_);
  }
  [[gnu::always_inline]] T turned_stress(const Stress<StressState::space>& sigma, double p) const {
    return turned_deviator(R_half_, turned_deviator(R_half_, deviator(sigma, p)));
  }
  template <class Modulus>
  [[gnu::always_inline]] T turned_stretch(const Modulus& G) const {
    return turned_deviator(R_half_, stretch(G));
  }
  /// R½ (R½ s R½ᵀ + 2 G dev d) R½ᵀ
  template <class Modulus>
  [[gnu::always_inline]] T turned_sum(const Stress<StressState::space>& sigma, double p, const Modulus& G) const {
    return turned_deviator(R_half_, turned_deviator(R_half_, deviator(sigma, p)) + stretch(G));
  }

  [[gnu::always_inline]] T rotation() const { return R_half_ * R_half_; }

  Number volume_change;
  Number det_g;

 private:
  [[gnu::always_inline]] static T deviator(const Stress<StressState::space>& sigma, double p) {
    const Number xy = sigma[3], yz = sigma[4], zx = sigma[5];
    return {sigma[0] - p, xy, zx, xy, sigma[1] - p, yz, zx, yz, sigma[2] - p};
  }
  template <class Modulus>
  [[gnu::always_inline]] T stretch(const Modulus& G) const {
    const Number shear = G * by_det_, twice = 2 * shear, mean = (2.0 / 3) * (G * volume_change);
    const Number xy = shear * xy_, yz = shear * yz_, zx = shear * zx_;
    return {twice * xx_ - mean, xy, zx, xy, twice * yy_ - mean, yz, zx, yz, twice * zz_ - mean};
  }

  Number xx_, yy_, zz_, xy_, yz_, zx_;  // det g d, shears doubled
  Number by_det_;                       // 1/det g
  T R_half_;
};

template <StressState S, class Number>
using Increment = std::conditional_t<S == StressState::space, SpaceIncrement<Number>, PlaneIncrement<S, Number>>;

/// The elastic trial of an increment.
template <StressState S, class Number>
struct StressTrial {
  double mean;              // p at the start [Pa]
  Number volume_change;     // tr d
  DeviatorOf<S, Number> s;  // R s Rᵀ + 2 G R½ dev d R½ᵀ [Pa]
  Number det_g;
};

/// The trial from the stress sigma with the shear modulus G [Pa].
template <StressState S, class Number>
[[gnu::always_inline]] inline StressTrial<S, Number> stress_trial(const GradientOf<S, Number>& H,
                                                                  const GradientOf<S, Number>& dH,
                                                                  const Stress<S>& sigma, double G) {
  const Increment<S, Number> increment(H, dH);
  const double p = (sigma[0] + sigma[1] + sigma[2]) * (1.0 / 3);
  return {p, increment.volume_change, increment.turned_sum(sigma, p, G), increment.det_g};
}

/// The ratio of volumes det(I + H).
template <StressState S, class Number>
[[gnu::always_inline]] inline Number volume_ratio(const GradientOf<S, Number>& H) {
  if constexpr (S == StressState::space) {
    return determinant(SpaceTensorOf<Number>{1 + H[0], H[1], H[2], H[3], 1 + H[4], H[5], H[6], H[7], 1 + H[8]});
  } else if constexpr (S == StressState::axisymmetric) {
    return ((1 + H[0]) * (1 + H[3]) - H[1] * H[2]) * (1 + H[4]);
  } else {
    return (1 + H[0]) * (1 + H[3]) - H[1] * H[2];
  }
}

/// P = det(f) σ f⁻ᵀ = σ cof f; NaN, through the shear stresses, if f or g is turned inside out.
template <StressState S, class Number>
[[gnu::always_inline]] inline GradientOf<S, Number> nominal_stress(
    const GradientOf<S, Number>& H, const Number& det_g, const std::array<Number, stress_components(S)>& sigma) {
  const Number nan = std::numeric_limits<double>::quiet_NaN();
  if constexpr (S == StressState::space) {
    using T = SpaceTensorOf<Number>;
    const auto& [xx, yy, zz, xy, yz, zx] = sigma;
    const T f{1 + H[0], H[1], H[2], H[3], 1 + H[4], H[5], H[6], H[7], 1 + H[8]}, cof_f = cofactor(f);
    const Number det_f = f.xx * cof_f.xx + f.xy * cof_f.xy + f.xz * cof_f.xz;
    const Number one = 1, good = det_f > 0 && det_g > 0 ? one : nan;
    const T P = T{xx, good * xy, good * zx, good * xy, yy, good * yz, good * zx, good * yz, zz} * cof_f;
    return {P.xx, P.xy, P.xz, P.yx, P.yy, P.yz, P.zx, P.zy, P.zz};
  } else {
    const auto& [xx, yy, zz, xy] = sigma;
    const Number fxx = 1 + H[0], fxy = H[1], fyx = H[2], fyy = 1 + H[3], det_f = fxx * fyy - fxy * fyx;
    if constexpr (S == StressState::axisymmetric) {
      const Number hoop = 1 + H[4], s = det_f > 0 && det_g > 0 && hoop > 0 ? xy : nan;
      return {hoop * (xx * fyy - s * fxy), hoop * (s * fxx - xx * fyx), hoop * (s * fyy - yy * fxy),
              hoop * (yy * fxx - s * fyx), zz * det_f};
    } else {
      const Number s = det_f > 0 && det_g > 0 ? xy : nan;
      return {xx * fyy - s * fxy, s * fxx - xx * fyx, s * fyy - yy * fxy, yy * fxx - s * fyx};
    }
  }
}

/// The elastic rate from a committed stress σ: δσ = C : d + w σ − σ w. The derivative of the trial also has the term
/// σ tr d, which is left out as if Jaumann's rate of τ were the elastic one: ∂P/∂H is then symmetric and frequencies
/// are real, at an error of σ/K.
template <StressState S>
class ElasticRate {
  using Tensor = TensorFor<S>;

 public:
  ElasticRate(const Gradient<S>& H, const Stress<S>& stress, double bulk_modulus, double shear_modulus)
      : f_(deformation_gradient<S>(H)),
        sigma_(stress_tensor<S>(stress)),
        J_(determinant(f_)),
        lambda_(bulk_modulus - 2 * shear_modulus / 3),
        G_(shear_modulus) {}

  /// The rate of P under dH.
  Gradient<S> rate(const Gradient<S>& dH) const { return stress_rate<S>(inverse(f_), J_ * sigma_, rate_of_tau(), dH); }
  Moduli<S> moduli() const { return moduli_of_rate<S>(f_, J_ * sigma_, rate_of_tau()); }

 private:
  auto rate_of_tau() const {
    return [this](const Tensor& l) {
      const Tensor d = 0.5 * (l + transpose(l)), w = l - d;
      return J_ * ((lambda_ * trace(d)) * identity<Tensor> + 2 * G_ * d + w * sigma_ - sigma_ * w);
    };
  }

  Tensor f_, sigma_;
  double J_, lambda_, G_;
};

}  // namespace stillpoint
