// A bar along x with the rectangular section |y| ≤ a, |z| ≤ b, twisted by α x and free to warp [Saint-Venant 1855;
// Timoshenko and Goodier 1970, art. 109]:
//
//   u_x = α ψ(y, z),  u_y = −α x z,  u_z = α x y,   τ_xy = μ α (∂ψ/∂y − z),  τ_zx = μ α (∂ψ/∂z + y),
//   ψ = y z − (32 a²/π³) Σ_n (−1)ⁿ/(2n + 1)³ sin(k_n y) sinh(k_n z)/cosh(k_n b),   k_n = (2n + 1) π/(2a)
//
// ψ is harmonic, and no traction acts on the sides. Exchanging y and z gives −ψ: of the two series the one whose terms
// decay faster is used.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "exact/bar_in_space.hpp"
#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"

namespace stillpoint {
namespace {

struct Warping {
  double psi, by_y, by_z;  // ψ [m²] and its derivatives [m]
};

Warping series_along_y(double a, double b, double y, double z) {
  constexpr double pi = std::numbers::pi, rounding = 1e-17;
  constexpr int most = 2000;  // terms: at an edge they fall only as 1/n²
  Warping sum{y * z, z, y};
  double sign = 1;
  for (int n = 0; n < most; ++n, sign = -sign) {
    const double odd = 2 * n + 1, k = odd * pi / (2 * a), share = 16 * a / (pi * pi * odd * odd);
    const HyperbolicRatios at = over_cosh(k * z, k * b);
    sum.psi -= sign * share / k * std::sin(k * y) * at.sinh;
    sum.by_y -= sign * share * std::cos(k * y) * at.sinh;
    sum.by_z -= sign * share * std::sin(k * y) * at.cosh;
    if (share * at.cosh < rounding * a) break;
  }
  return sum;
}

Warping warping(double a, double b, double y, double z) {
  if ((b - std::abs(z)) / a >= (a - std::abs(y)) / b) return series_along_y(a, b, y, z);
  const Warping turned = series_along_y(b, a, z, y);
  return {-turned.psi, -turned.by_z, -turned.by_y};
}

class Torsion final : public ExactSolution {
 public:
  explicit Torsion(const Problem& problem)
      : mu_(elastic_constants(problem).mu),
        a_(parameter(problem, "depth") / 2),
        b_(parameter(problem, "width") / 2),
        alpha_(parameter(problem, "twist")),
        start_{parameter(problem, "x0"), parameter(problem, "y0"), parameter(problem, "z0")} {}

  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    const double x = X[0] - start_[0], y = X[1] - start_[1], z = X[2] - start_[2];
    u[0] = alpha_ * warping(a_, b_, y, z).psi;
    u[1] = -alpha_ * x * z;
    u[2] = alpha_ * x * y;
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double, std::span<double> sigma) const override {
    const double y = X[1] - start_[1], z = X[2] - start_[2];
    const Warping psi = warping(a_, b_, y, z);
    std::ranges::fill(sigma, 0.0);
    sigma[3] = mu_ * alpha_ * (psi.by_y - z);
    sigma[5] = mu_ * alpha_ * (psi.by_z + y);
  }

 private:
  double mu_;                    // [Pa]
  double a_, b_;                 // halves of the section's sides along y and z [m]
  double alpha_;                 // [rad/m]
  std::array<double, 3> start_;  // start of the axis, which does not rotate [m]
};

}  // namespace

KnownSolution torsion_solution() {
  ParameterInfo twist = any_parameter("twist", "rad/m", "angle per length");
  twist.required = true;
  return {.about = {.name = "torsion",
                    .description = "a bar of rectangular section along x, twisted and free to warp",
                    .source = "Saint-Venant 1855; Timoshenko and Goodier 1970, art. 109",
                    .states = {StressState::space},
                    .parameters = {positive_parameter("depth", "m", "of the section, along y"),
                                   positive_parameter("width", "m", "along z"), twist,
                                   any_parameter("x0", "m", "of the section that does not turn"),
                                   any_parameter("y0", "m", "of the axis"), any_parameter("z0", "m", "likewise")},
                    .fault = fault_of_section},
          .make = make_solution<Torsion>};
}

}  // namespace stillpoint
