// A cantilever 0 < x < l with the rectangular section |y| ≤ a, |z| ≤ b, under the load W along y at its end
// [Saint-Venant 1856; Love 1927, art. 229-231; Timoshenko and Goodier 1970, art. 122 and 124]:
//
//   σ_xx = −W (l − x) y/I,   τ_xy = W (a² − y²)/(2I) + ∂φ/∂z,   τ_zx = −∂φ/∂y,   I = 4 a³ b/3,
//   φ = κ [(z³ − b² z)/6 − (2b³/π³) Σ_n (−1)ⁿ/n³ sin(k_n z) cosh(k_n y)/cosh(k_n a)],  κ = ν W/((1 + ν) I),  k_n = n
//   π/b
//
//   u_x = −(W/EI) [y (l x − x²/2) + χ + y z²] − θ y,   u_z = (W/EI) ν (l − x) y z,
//   u_y = (W/EI) [ν (l − x)(y² − z²)/2 + l x²/2 − x³/6] + θ x,
//   χ = (1 + ν/2)(y³/3 − y z²) − ((1 + ν) a² − ν b²/3) y + (4ν b³/π³) Σ_n (−1)ⁿ/n³ cos(k_n z) sinh(k_n y)/cosh(k_n a)
//
// The section at x = 0 warps, and its mean rotation ∫ y u_x dA/I is 0 [Cowper 1966]:
// θ = (W/EI)[(0.8 + 0.9 ν) a² − ν b²/6], for a square section W/(k G A) with k = 10 (1 + ν)/(12 + 11 ν), Timoshenko's
// shear coefficient.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "exact/bar_in_space.hpp"
#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"

namespace stillpoint {
namespace {

/// The sums of the series in χ/ν, ∂φ/∂z and ∂φ/∂y.
struct Series {
  double warping = 0;               // (4b³/π³) Σ (−1)ⁿ/n³ cos(k_n z) sinh(k_n y)/cosh(k_n a) [m³]
  double along_y = 0, along_z = 0;  // (2b²/π²) Σ (−1)ⁿ/n² cos cosh/cosh, and sin sinh/cosh [m²]
};

Series series(double a, double b, double y, double z) {
  constexpr double pi = std::numbers::pi, rounding = 1e-17;
  constexpr int most = 4000;  // terms: at the top and the bottom they fall only as 1/n²
  Series sum;
  double sign = -1;
  for (int n = 1; n <= most; ++n, sign = -sign) {
    const double k = n * pi / b, share = 2 / (k * k);
    const HyperbolicRatios at = over_cosh(k * y, k * a);
    sum.warping += sign * 2 * share / k * std::cos(k * z) * at.sinh;
    sum.along_y += sign * share * std::cos(k * z) * at.cosh;
    sum.along_z += sign * share * std::sin(k * z) * at.sinh;
    if (share * at.cosh < rounding * b * b) break;
  }
  return sum;
}

class Flexure final : public ExactSolution {
 public:
  explicit Flexure(const Problem& problem)
      : nu_(elastic_constants(problem).nu),
        l_(parameter(problem, "length")),
        a_(parameter(problem, "depth") / 2),
        b_(parameter(problem, "width") / 2),
        per_I_(parameter(problem, "load") * 3 / (4 * a_ * a_ * a_ * b_)),
        curvature_(per_I_ / elastic_constants(problem).E),
        theta_(curvature_ * ((0.8 + 0.9 * nu_) * a_ * a_ - nu_ * b_ * b_ / 6)),
        start_{parameter(problem, "x0"), parameter(problem, "y0"), parameter(problem, "z0")} {}

  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    const double x = X[0] - start_[0], y = X[1] - start_[1], z = X[2] - start_[2];
    const double chi = (1 + nu_ / 2) * (y * y * y / 3 - y * z * z) - ((1 + nu_) * a_ * a_ - nu_ * b_ * b_ / 3) * y +
                       nu_ * series(a_, b_, y, z).warping;
    u[0] = -curvature_ * (y * (l_ * x - x * x / 2) + chi + y * z * z) - theta_ * y;
    u[1] = curvature_ * (nu_ * (l_ - x) * (y * y - z * z) / 2 + l_ * x * x / 2 - x * x * x / 6) + theta_ * x;
    u[2] = curvature_ * nu_ * (l_ - x) * y * z;
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double, std::span<double> sigma) const override {
    const double x = X[0] - start_[0], y = X[1] - start_[1], z = X[2] - start_[2];
    const double kappa = nu_ / (1 + nu_) * per_I_;
    const Series of = series(a_, b_, y, z);
    std::ranges::fill(sigma, 0.0);
    sigma[0] = -per_I_ * (l_ - x) * y;
    sigma[3] = per_I_ * (a_ * a_ - y * y) / 2 + kappa * ((3 * z * z - b_ * b_) / 6 - of.along_y);
    sigma[5] = kappa * of.along_z;
  }

 private:
  double nu_;
  double l_, a_, b_;             // [m]
  double per_I_;                 // W/I [N/m⁴]
  double curvature_;             // W/EI, curvature of the axis per length [1/m²]
  double theta_;                 // θ
  std::array<double, 3> start_;  // start of the axis [m]
};

std::optional<SolutionFault> flexure_fault(const Problem& problem) {
  if (auto fault = fault_of_section(problem)) return fault;
  return fault_of_extent(problem, "length", 0, parameter(problem, "x0"), parameter(problem, "length"));
}

}  // namespace

KnownSolution flexure_solution() {
  ParameterInfo load = any_parameter("load", "N", "along y, at the end");
  load.required = true;
  return {
      .about = {.name = "flexure",
                .description = "a cantilever of rectangular section along x, under a load at its end, whose root may "
                               "warp but has no mean rotation",
                .source = "Saint-Venant 1856; Love 1927, art. 229-231; Cowper 1966",
                .states = {StressState::space},
                .parameters = {positive_parameter("length", "m", "of the beam"),
                               positive_parameter("depth", "m", "of its section, along y"),
                               positive_parameter("width", "m", "along z"), load,
                               any_parameter("x0", "m", "of the root"), any_parameter("y0", "m", "of the axis"),
                               any_parameter("z0", "m", "likewise")},
                .fault = flexure_fault},
      .make = make_solution<Flexure>};
}

}  // namespace stillpoint
