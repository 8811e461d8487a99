// An increment of deformation for laws that are told a strain and give a stress: UMATs, and laws in Python. What turns
// is no matter of theirs. It is the increment of stress_increment.hpp, so that their answers agree with those of
// built-in laws on any path:
//
//   l = dH g⁻¹ = d + w,   Δε = R½ d R½ᵀ,   R = R½ R½,   σ = law(R σ_n Rᵀ, Δε),   P = σ cof f
//
// Vectors of strain have engineering shears.
#pragma once

#include <stillpoint/dual.hpp>
#include <stillpoint/stress_increment.hpp>
#include <stillpoint/unroll.hpp>

#include <array>
#include <cstddef>

namespace stillpoint {

template <class Number>
struct TurnedIncrement {
  SpaceTensorOf<Number> strain, rotation;  // Δε, R
  Number det_g;                            // as StressTrial has it: in two dimensions of the plane's part
};

/// A stress in three dimensions.
template <StressState S>
constexpr SpaceTensor stress_in_space(const Stress<S>& s) {
  if constexpr (S == StressState::space) {
    return stress_tensor<S>(s);
  } else {
    return {s[0], s[3], 0, s[3], s[1], 0, 0, 0, s[2]};
  }
}
template <StressState S>
constexpr Stress<S> stress_vector(const SpaceTensor& s) {
  if constexpr (S == StressState::space) {
    return stress_part<S>(s);
  } else {
    return {s.xx, s.yy, s.zz, s.xy};
  }
}
template <StressState S>
constexpr Stress<S> strain_vector(const SpaceTensor& d) {
  Stress<S> e = stress_vector<S>(d);
  for (std::size_t a = 3; a < e.size(); ++a) e[a] *= 2;
  return e;
}
template <StressState S, class Number>
[[gnu::always_inline]] inline TurnedIncrement<Number> turned_increment(const GradientOf<S, Number>& H,
                                                                       const GradientOf<S, Number>& dH) {
  const Increment<S, Number> increment(H, dH);
  const Number third = increment.volume_change * (1.0 / 3), none = 0;
  const DeviatorOf<S, Number> dev = increment.turned_stretch(0.5);  // 2 G = 1
  if constexpr (S == StressState::space) {
    return {{third + dev.xx, dev.xy, dev.xz, dev.yx, third + dev.yy, dev.yz, dev.zx, dev.zy, third + dev.zz},
            increment.rotation(),
            increment.det_g};
  } else {
    const Number in_plane = third - 0.5 * dev.zz;
    return {{in_plane + dev.half, dev.shear, none, dev.shear, in_plane - dev.half, none, none, none, third + dev.zz},
            increment.rotation(),
            increment.det_g};
  }
}

/// The stress R σ Rᵀ.
template <StressState S>
[[gnu::always_inline]] inline Stress<S> turned_stress(const SpaceTensor& R, const Stress<S>& s) {
  if constexpr (S == StressState::space) {
    const SpaceTensor after = turned(R, SpaceTensor{s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]});
    return {after.xx, after.yy, after.zz, after.xy, after.yz, after.zx};
  } else {
    const double half = (s[0] - s[1]) / 2, mean = (s[0] + s[1]) / 2;
    const double cos2 = 1 - 2 * R.yx * R.yx, sin2 = 2 * R.yx * R.xx;
    const double turned_half = cos2 * half - sin2 * s[3], turned_shear = sin2 * half + cos2 * s[3];
    return {mean + turned_half, mean - turned_half, s[2], turned_shear};
  }
}
/// A strain with engineering shears, likewise.
template <StressState S>
[[gnu::always_inline]] inline Stress<S> turned_strain(const SpaceTensor& R, Stress<S> e) {
  unroll<stress_components(S) - 3>([&](auto k) __attribute__((always_inline)) { e[3 + k] *= 0.5; });
  Stress<S> after = turned_stress<S>(R, e);
  unroll<stress_components(S) - 3>([&](auto k) __attribute__((always_inline)) { after[3 + k] *= 2; });
  return after;
}

/// The increment as the law is told it.
template <std::size_t N>
TurnedIncrement<double> values_of(const TurnedIncrement<Dual<N>>& by) {
  const auto values = [](const SpaceTensorOf<Dual<N>>& A) {
    return SpaceTensor{A.xx.value, A.xy.value, A.xz.value, A.yx.value, A.yy.value,
                       A.yz.value, A.zx.value, A.zy.value, A.zz.value};
  };
  return {values(by.strain), values(by.rotation), by.det_g.value};
}

/// ∂σ/∂Δε of a law with ∂σ_a/∂Δε_b = C[a, b].
template <StressState S>
using StrainModuli = std::array<Stress<S>, stress_components(S)>;

/// The consistent moduli ∂P/∂H, H and dH changing alike, of an increment after which the stress is σ. As the answer of
/// a law turns as all turns that is given to it, with Ω = δR Rᵀ
///   δσ = Ω σ − σ Ω + C : (δΔε − (Ω Δε − Δε Ω)).
template <StressState S>
Moduli<S> moduli_of_increment(const Gradient<S>& H, const TurnedIncrement<Dual<gradient_components(S)>>& by,
                              const Stress<S>& sigma, const StrainModuli<S>& C) {
  constexpr std::size_t n = gradient_components(S);
  using Number = Dual<n>;
  const TurnedIncrement<double> now = values_of(by);
  const SpaceTensor in_space = stress_in_space<S>(sigma);
  std::array<Number, stress_components(S)> stress;
  for (std::size_t a = 0; a < stress.size(); ++a) stress[a] = sigma[a];
  for (std::size_t b = 0; b < n; ++b) {
    const auto derivative = [b](const SpaceTensorOf<Number>& A) {
      return SpaceTensor{A.xx.derivative[b], A.xy.derivative[b], A.xz.derivative[b],
                         A.yx.derivative[b], A.yy.derivative[b], A.yz.derivative[b],
                         A.zx.derivative[b], A.zy.derivative[b], A.zz.derivative[b]};
    };
    const SpaceTensor spin = derivative(by.rotation) * transpose(now.rotation);
    const auto turn = [&spin](const SpaceTensor& s) { return spin * s - s * spin; };
    const Stress<S> strain = strain_vector<S>(derivative(by.strain) - turn(now.strain));
    const Stress<S> of_turn = stress_vector<S>(turn(in_space));
    for (std::size_t a = 0; a < stress.size(); ++a) {
      double change = of_turn[a];
      for (std::size_t k = 0; k < strain.size(); ++k) change += C[a][k] * strain[k];
      stress[a].derivative[b] = change;
    }
  }
  const auto P = nominal_stress<S, Number>(variables(H), by.det_g, stress);
  Moduli<S> A;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) A[n * a + b] = P[a].derivative[b];
  }
  return A;
}

/// The moduli of an elastic trial from the committed stress σ, as ElasticRate has them, for any symmetric C.
template <StressState S>
Moduli<S> elastic_moduli_of(const Gradient<S>& H, const Stress<S>& sigma, const StrainModuli<S>& C) {
  using Tensor = TensorFor<S>;
  const Tensor F = deformation_gradient<S>(H), stress = stress_tensor<S>(sigma);
  const double J = determinant(F);
  return moduli_of_rate<S>(F, J * stress, [&](const Tensor& l) {
    const Tensor d = 0.5 * (l + transpose(l)), w = l - d;
    const Stress<S> of_d = stress_part<S>(d);
    Stress<S> rate{};
    for (std::size_t a = 0; a < rate.size(); ++a) {
      for (std::size_t b = 0; b < rate.size(); ++b) rate[a] += C[a][b] * (b < 3 ? 1 : 2) * of_d[b];
    }
    return J * (stress_tensor<S>(rate) + w * stress - stress * w);
  });
}

}  // namespace stillpoint
