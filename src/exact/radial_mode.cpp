// Free radial vibration of a solid cylinder, or in plane stress of a disc [Love 1927, art. 200; Pochhammer 1876]:
//
//   u_r = A J_1(k r) cos(ω t),   ω = c k,   ρ c² = λ' + 2μ
//   free edge   (λ' + 2μ) k R J_0(k R) = 2μ J_1(k R)       held edge   J_1(k R) = 0
//
// λ' = λ if the length is fixed (plane strain, axisymmetric), 2λμ/(λ + 2μ) in plane stress; k R is the number-th
// positive root. The free edge's equation has one root between two successive zeros of J_1, on which J_0 has its
// extrema, and one before the first zero.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/special_functions.hpp"
#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"
#include "exact/polar.hpp"

namespace stillpoint {
namespace {

/// The n-th positive zero of J_1, 0 for n = 0; it lies within 0.1 of π (n + 1/4).
double zero_of_j1(int n) {
  if (n == 0) return 0;
  const double about = std::numbers::pi * (n + 0.25);
  return zero_between(about - 0.5, about + 0.5, bessel_j1);
}

class RadialMode final : public ExactSolution {
 public:
  explicit RadialMode(const Problem& problem)
      : of_(elastic_constants(problem)),
        is_around_axis_(problem.state == StressState::axisymmetric),
        centre_{parameter(problem, "x0"), parameter(problem, "y0")},
        amplitude_(parameter(problem, "amplitude")) {
    if (of_.is_plane_stress) of_.lambda *= 2 * of_.mu / (of_.lambda + 2 * of_.mu);
    const double modulus = of_.lambda + 2 * of_.mu;
    const int n = static_cast<int>(parameter(problem, "mode"));
    double root = zero_of_j1(n);
    if (problem.exact.choices.at("edge") == "free") {
      const auto pressure = [&](double x) { return modulus * x * bessel_j0(x) - 2 * of_.mu * bessel_j1(x); };
      // The function also vanishes at 0, where it rises with λ' + μ.
      root = zero_between(n == 1 ? 1e-6 : zero_of_j1(n - 1), root, pressure);
    }
    k_ = root / parameter(problem, "radius");
    omega_ = k_ * std::sqrt(modulus / of_.rho);
  }

  void displacement(std::span<const double> X, double t, std::span<double> u) const override {
    const double swing = amplitude_ * std::cos(omega_ * t);
    if (is_around_axis_) {
      u[0] = swing * bessel_j1(k_ * X[0]);
      u[1] = 0;
      return;
    }
    const PolarPosition at(X, centre_);
    const auto [u_x, u_y] = at.cartesian(swing * bessel_j1(k_ * at.r), 0);
    u[0] = u_x;
    u[1] = u_y;
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double t, std::span<double> sigma) const override {
    const PolarPosition at(X, centre_);
    const double r = is_around_axis_ ? X[0] : at.r, swing = amplitude_ * std::cos(omega_ * t);
    // By J_1' = J_0 − J_1/x:
    const double hoop = swing * (k_ * r > 0 ? bessel_j1(k_ * r) / r : k_ / 2);
    const double radial = swing * k_ * bessel_j0(k_ * r) - hoop;
    const double volumetric = of_.lambda * (radial + hoop);
    const double rr = volumetric + 2 * of_.mu * radial, theta_theta = volumetric + 2 * of_.mu * hoop;
    const double zz = of_.is_plane_stress ? 0 : volumetric;
    if (is_around_axis_) {
      sigma[0] = rr;
      sigma[1] = zz;
      sigma[2] = theta_theta;
      sigma[3] = 0;
      return;
    }
    const auto [xx, yy, xy] = at.cartesian(rr, theta_theta, 0);
    sigma[0] = xx;
    sigma[1] = yy;
    sigma[2] = zz;
    sigma[3] = xy;
  }

 private:
  ElasticConstants of_;  // with λ'
  bool is_around_axis_;
  std::array<double, 2> centre_;  // [m]
  double amplitude_;              // A [m]
  double k_ = 0, omega_ = 0;      // [1/m], [1/s]
};

std::optional<SolutionFault> radial_mode_fault(const Problem& problem) {
  constexpr double most = 1000;
  const double n = parameter(problem, "mode");
  if (n == std::floor(n) && n >= 1 && n <= most) return fault_of_centre(problem);
  return SolutionFault{"mode", fmt::format("must be a whole number from 1 to {}, not {}", most, n)};
}

}  // namespace

KnownSolution radial_mode_solution() {
  using enum StressState;
  ParameterInfo amplitude = any_parameter("amplitude", "m", "A of u_r = A J_1(k r) cos(omega t)");
  amplitude.required = true;
  ParameterInfo mode = positive_parameter("mode", "1", "its number, from 1");
  mode.required = false;
  mode.fallback = 1;
  return {.about = {.name = "radial-mode",
                    .description = "free vibration of a solid cylinder or disc along its radius, at rest and at its "
                                   "largest at t = 0",
                    .source = "Pochhammer 1876; Love 1927, art. 200; by Bessel's functions",
                    .states = {plane_strain, plane_stress, axisymmetric},
                    .parameters = {positive_parameter("radius", "m", "of the cylinder"), amplitude, mode,
                                   any_parameter("x0", "m", "of its centre, in a plane"),
                                   any_parameter("y0", "m", "likewise")},
                    .choices = {{"edge", "whether the outer edge is free or held", {"free", "held"}, "free"}},
                    .fault = radial_mode_fault},
          .make = make_solution<RadialMode>};
}

}  // namespace stillpoint
