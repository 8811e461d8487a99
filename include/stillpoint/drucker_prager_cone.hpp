// Drucker–Prager's cone f = √J₂ + η p − ξ c (tension positive), matched to Mohr–Coulomb's pyramid R + p_m sin φ − c cos
// φ with R = (σ₁ − σ₃)/2 and p_m = (σ₁ + σ₃)/2. A match fixes the ratio r in η = r sin φ and ξ = r cos φ, so ξ = η cot
// φ:
//   plane strain   r = 1/(√(1 − η̄²/3) + (η̄/3) sin φ)    the two fail together while flowing in plane strain
//   compression    r = 6/(√3 (3 − sin φ))               the outer edges of the pyramid
//   extension      r = 6/(√3 (3 + sin φ))               the inner edges
//   mean           r = 18/(√3 (9 − sin² φ))             half-way between the last two
// and the potential √J₂ + η̄ p has η̄ = r(ψ) sin ψ by the same family; in plane strain η̄ = 3 sin ψ/√(9 + 3 sin² ψ), for
// which sin ψ = (d₁ᵖ + d₃ᵖ)/(d₁ᵖ − d₃ᵖ).
//
// Plane strain: no plastic flow out of the plane leaves s_zz = −(2/3) η̄ √J₂, so R² = (1 − η̄²/3) J₂, p_m = p + (η̄/3)
// √J₂. [Drucker and Prager 1952 for ψ = φ; de Souza Neto, Perić and Owen 2008, §6.4.4 for the edges]
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace stillpoint {

enum class Cone { plane_strain, mean, compression, extension };

/// The names of the cones in a scene.
inline constexpr std::array<std::pair<std::string_view, Cone>, 4> cone_words = {{{"plane-strain", Cone::plane_strain},
                                                                                 {"mean", Cone::mean},
                                                                                 {"compression", Cone::compression},
                                                                                 {"extension", Cone::extension}}};
inline Cone cone_of(std::string_view word) {
  for (const auto& [name, cone] : cone_words) {
    if (name == word) return cone;
  }
  throw std::invalid_argument("no cone is called \"" + std::string(word) + "\"");
}

struct ConeCoefficients {
  double eta, xi, eta_bar;

  // Coefficients of a cone for φ and ψ in degrees.
  static ConeCoefficients from(Cone cone, double phi, double psi) {
    constexpr double degree = std::numbers::pi / 180;
    const double sin_phi = std::sin(phi * degree), sin_psi = std::sin(psi * degree);
    double r, eta_bar;
    if (cone == Cone::plane_strain) {
      eta_bar = 3 * sin_psi / std::sqrt(9 + 3 * sin_psi * sin_psi);
      r = 1 / (std::sqrt(1 - eta_bar * eta_bar / 3) + eta_bar / 3 * sin_phi);
    } else {
      r = edge_ratio(cone, sin_phi);
      eta_bar = edge_ratio(cone, sin_psi) * sin_psi;
    }
    return {r * sin_phi, r * std::cos(phi * degree), eta_bar};
  }

 private:
  static double edge_ratio(Cone cone, double sine) {
    constexpr double root = std::numbers::sqrt3;
    if (cone == Cone::compression) return 6 / (root * (3 - sine));
    if (cone == Cone::extension) return 6 / (root * (3 + sine));
    return 18 / (root * (9 - sine * sine));
  }
};

}  // namespace stillpoint
