// The return of principal stresses to Mohr–Coulomb's pyramid with a tension cut-off. Tension is positive, σ₁ ≥ σ₂ ≥ σ₃:
//
//   f = σ₁ (1 + sin φ) − σ₃ (1 − sin φ) − 2 c cos φ ≤ 0,   flow by the same with ψ,   σ₁ ≤ σ_t, associated.
//
// In principal stresses all surfaces are planes, so that each return is closed [Clausen, Damkilde and Andersen 2007; de
// Souza Neto, Perić and Owen 2008, §8.2]. The trial goes
//   to the pyramid alone: a face, or the edge σ₁ = σ₂ or σ₂ = σ₃ where the face would leave σ₂ outside;
//   or to the cut-off alone: σ₁ = σ_t, then σ₂ too, then all three;
//   or, if the first is beyond the cut-off and the second beyond the pyramid, to the line that both share, whose σ₁ and
//   σ₃ are known; the strain ε₂ stays elastic, and σ₂ ends where σ₁ or σ₃ is.
// For an associated flow this is the nearest position in the elastic energy's norm; else it is Koiter's.
#pragma once

#include <stillpoint/principal_stresses.hpp>
#include <stillpoint/stress_history.hpp>

namespace stillpoint {

struct MohrCoulombStrength {
  double sin_phi, sin_psi;
  double k;        // c cos φ [Pa]
  double tension;  // σ_t [Pa], the apex c cot φ at most; infinite for φ = 0 without a cut-off
  double sigma_3;  // σ₃ where pyramid and cut-off meet [Pa]

  /// The strength for a σ_t that may lie beyond the apex.
  [[gnu::always_inline]] static MohrCoulombStrength from(double sin_phi, double sin_psi, double k, double tension) {
    const double apex = k / (sin_phi + vanishing_product);
    const bool is_apex = !(tension < apex);
    const double cut = is_apex ? apex : tension, line = (cut * (1 + sin_phi) - 2 * k) / (1 - sin_phi);
    return {sin_phi, sin_psi, k, cut, is_apex ? cut : line};
  }
};

template <class Number>
[[gnu::always_inline]] inline Number yield_function(const Number& largest, const Number& least,
                                                    const MohrCoulombStrength& of) {
  return largest * (1 + of.sin_phi) - least * (1 - of.sin_phi) - 2 * of.k;
}

/// The return to the pyramid of a trial x with f > 0. With n = (1 + sin ψ, 0, −(1 − sin ψ)) the flow of the face and C
/// the elastic moduli, Δγ = f(x)/f'(C n), and on an edge both faces flow: the sum of their Δγ is that of f over f'.
template <class Number>
[[gnu::always_inline]] inline Principal<Number> returned_to_pyramid(const Principal<Number>& x,
                                                                    const MohrCoulombStrength& of,
                                                                    const IsotropicModuli& elastic) {
  const double s = of.sin_phi, d = of.sin_psi, G = elastic.shear, lambda = elastic.bulk - 2 * G / 3;
  const double volume = 2 * lambda * d, up = volume + 2 * G * (1 + d), down = volume - 2 * G * (1 - d);  // C n
  const double face = up * (1 + s) - down * (1 - s);                                                     // f'(C n)
  const double beside_1 = face + (volume * (1 + s) - down * (1 - s));  // with that of the face 2–3
  const double beside_3 = face + (up * (1 + s) - volume * (1 - s));    // with that of the face 1–2

  const Number f = yield_function(x[0], x[2], of), on_face = f * (1 / face);
  const Principal<Number> y{x[0] - up * on_face, x[1] - volume * on_face, x[2] - down * on_face};

  const Number at_1 = (f + yield_function(x[1], x[2], of)) * (1 / beside_1);
  const Number mean_12 = (x[0] + x[1] - (up + volume) * at_1) / 2;
  const Number at_3 = (f + yield_function(x[0], x[1], of)) * (1 / beside_3);
  const Number mean_23 = (x[1] + x[2] - (down + volume) * at_3) / 2;

  const bool beyond_1 = y[1] > y[0], beyond_3 = y[2] > y[1];
  return {either(beyond_1, mean_12, either(beyond_3, Number(x[0] - up * at_3), y[0])),
          either(beyond_1, mean_12, either(beyond_3, mean_23, y[1])),
          either(beyond_1, Number(x[2] - down * at_1), either(beyond_3, mean_23, y[2]))};
}

/// The return to the cut-off of a trial x with σ₁ > σ_t.
template <class Number>
[[gnu::always_inline]] inline Principal<Number> returned_to_cut_off(const Principal<Number>& x, double tension,
                                                                    const IsotropicModuli& elastic) {
  const double G = elastic.shear, lambda = elastic.bulk - 2 * G / 3;
  const Number cut = tension, one = (x[0] - cut) * (lambda / (lambda + 2 * G));
  const Number second = x[1] - one, two = (x[0] + x[1] - 2 * cut) * (lambda / (2 * (lambda + G)));
  const bool second_too = second > cut;
  const Number third = x[2] - either(second_too, two, one);
  // What stays below by rounding alone is as free as the rest.
  const Number close = cut - 1e-12 * (x[0] - cut);
  return {cut, either(second > close, cut, second), either(third > close, cut, third)};
}

/// The stress to which a trial x returns, x itself if it is neither beyond the pyramid nor beyond the cut-off.
template <class Number>
[[gnu::always_inline]] inline Principal<Number> returned(const Principal<Number>& x, const MohrCoulombStrength& of,
                                                         const IsotropicModuli& elastic) {
  const Number zero = 0, cut = of.tension;
  const Principal<Number> on_pyramid = returned_to_pyramid(x, of, elastic);
  const Principal<Number> on_cut_off = returned_to_cut_off(x, of.tension, elastic);

  // Δσ₂ = ν (Δσ₁ + Δσ₃) on the line
  const double nu = (3 * elastic.bulk - 2 * elastic.shear) / (2 * (3 * elastic.bulk + elastic.shear));
  const Number line_3 = of.sigma_3, along = x[1] + nu * ((cut - x[0]) + (line_3 - x[2]));
  const Principal<Number> on_both{cut, larger(smaller(along, cut), line_3), line_3};

  const bool yields = yield_function(x[0], x[2], of) > zero, opens = x[0] > cut;
  const bool stays = !(yields | opens), to_pyramid = yields & !(on_pyramid[0] > cut);
  const bool to_cut_off = opens & !(yield_function(on_cut_off[0], on_cut_off[2], of) > zero);
  const auto chosen = [&](int a) __attribute__((always_inline)) {
    return either(stays, x[a], either(to_pyramid, on_pyramid[a], either(to_cut_off, on_cut_off[a], on_both[a])));
  };
  return {chosen(0), chosen(1), chosen(2)};
}

}  // namespace stillpoint
