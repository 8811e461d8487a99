// Hencky's logarithmic elasticity at finite strain [Hencky 1928; Anand 1979]: Hooke's law between Kirchhoff's stress
// and the logarithmic strain,
//   W = μ tr(e²) + λ/2 (tr e)²,   e = ½ ln b, b = F Fᵀ,   τ = J σ = 2 μ e + λ tr(e) I,   P = τ F⁻ᵀ.
#pragma once

#include <stillpoint/logarithm.hpp>
#include <stillpoint/plane_tensor.hpp>

#include <cmath>

namespace stillpoint {

template <StressState S>
class Hencky {
 public:
  static constexpr StressState state = S;
  static constexpr bool finite_strain = true;

  explicit Hencky(const LameParameters& m)
      : uniaxial_(S == StressState::uniaxial_stress ? m.mu * (3 * m.lambda + 2 * m.mu) / (m.lambda + m.mu)  // E
                                                    : m.lambda + 2 * m.mu),
        // τ_zz = 0 for e_zz = −λ/(λ + 2μ) (e_xx + e_yy); what is left of λ is 2 λ μ/(λ + 2μ)
        lambda_(S == StressState::plane_stress ? 2 * m.lambda * m.mu / (m.lambda + 2 * m.mu) : m.lambda),
        mu_(m.mu),
        contraction_(S == StressState::uniaxial_stress ? m.lambda / (m.lambda + m.mu)
                     : S == StressState::plane_stress  ? m.lambda / (m.lambda + 2 * m.mu)
                                                       : 0) {}

  Gradient<S> first_piola(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      return {uniaxial_ * logarithm(1 + H[0]) / (1 + H[0])};
    } else {
      const PlaneTensor F = deformation_gradient<S>(H);
      return gradient_part<S>(kirchhoff(LogStrain(F)) * transpose(inverse(F)));
    }
  }

  // σ = τ/J; a free side or face has contracted by J = e^(tr e)
  Stress<S> cauchy(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      const double e = logarithm(1 + H[0]);
      return {uniaxial_ * e * std::exp((contraction_ - 1) * e)};
    } else {
      const LogStrain ln(deformation_gradient<S>(H));
      return stress_part<S>(std::exp((contraction_ - 1) * ln.J) * kirchhoff(ln));
    }
  }

  Moduli<S> moduli(const Gradient<S>& H) const {
    if constexpr (dimensions(S) == 1) {
      // d(E ln F/F)/dF = E (1 − ln F)/F²
      const double F = 1 + H[0];
      return {uniaxial_ * (1 - logarithm(F)) / (F * F)};
    } else {
      const PlaneTensor F = deformation_gradient<S>(H);
      const LogStrain ln(F);
      // δτ = 2 μ δe + λ tr(δe) I
      return moduli_of_rate<S>(F, kirchhoff(ln), [&](const PlaneTensor& l) { return stress(ln.rate(l), trace(l)); });
    }
  }

 private:
  // e = ½ ln b. In the plane, with the mean m = tr₂ b/2 of b's eigenvalues b₁, b₂ = m ± r, r = ‖dev₂ b‖/√2 and x = r/m,
  //   ln b = ½ ln(b₁ b₂) I + a/m dev₂ b,   a = artanh(x)/x = 1 + x²/3 + x⁴/5 + …,
  // a smooth function of y = x², so that equal eigenvalues are no exception.
  struct LogStrain {
    PlaneTensor b, dev;     // dev₂ b
    double m, y, a, slope;  // slope = da/dy
    double plane, zz, J;    // ln det₂F, ln F_zz and ln J, NaN if inside out

    explicit LogStrain(const PlaneTensor& F) : b(F * transpose(F)), m((b.xx + b.yy) / 2) {
      const double half = (b.xx - b.yy) / 2, plane_ratio = plane_determinant(F);
      dev = {half, b.xy, b.xy, -half, 0};
      y = (half * half + b.xy * b.xy) / (m * m);
      plane = logarithm(plane_ratio);
      zz = S == StressState::axisymmetric ? logarithm(F.zz) : 0;
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

    PlaneTensor strain() const { return PlaneTensor{plane / 2, 0, 0, plane / 2, zz} + a / (2 * m) * dev; }

    // δe for δb = l b + b lᵀ
    PlaneTensor rate(const PlaneTensor& l) const {
      const PlaneTensor db = l * b + b * transpose(l);
      const double dm = (db.xx + db.yy) / 2, dhalf = (db.xx - db.yy) / 2, dln = (l.xx + l.yy) / 2;
      const double dy = 2 * (dev.xx * dhalf + dev.xy * db.xy) / (m * m) - 2 * y * dm / m;
      const double change = slope * dy / m - a * dm / (m * m);  // of a/m
      return PlaneTensor{dln, 0, 0, dln, l.zz} + change / 2 * dev +
             a / (2 * m) * PlaneTensor{dhalf, db.xy, db.xy, -dhalf, 0};
    }

    // Below y = 0.01 the sums up to y⁸ are exact to rounding; above it the differences lose at most two digits.
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

  // 2 μ e + λ tr(e) I, without the stress across a free face
  PlaneTensor stress(const PlaneTensor& e, double trace_e) const {
    PlaneTensor tau = 2 * mu_ * e + lambda_ * trace_e * identity;
    if constexpr (S == StressState::plane_stress) tau.zz = 0;
    return tau;
  }
  PlaneTensor kirchhoff(const LogStrain& ln) const { return stress(ln.strain(), ln.J); }

  double uniaxial_;     // of one dimension [Pa]
  double lambda_, mu_;  // of two [Pa]
  double contraction_;  // −e of the free side (both of a bar's) per tr(e) of the others
};

}  // namespace stillpoint
