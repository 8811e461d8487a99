// A uniform pressure q on a strip |x| < b of the surface y = 0 of a half-plane y < 0 [Boussinesq 1885; Flamant 1892;
// Timoshenko and Goodier 1970, art. 37]. With z = −y, x_± = x ± b, θ_± = atan(x_±/z), s_± = z x_±/(x_±² + z²):
//
//   σ_yy, σ_xx = −(q/π) [θ_+ − θ_− ± (s_+ − s_−)],   σ_xy = (q/π) [z²/(x_−² + z²) − z²/(x_+² + z²)]
//
// The displacement, by Kolosov and Muskhelishvili's potential of a half-plane, with ζ = x + i y and C = q/(2πi):
//
//   2μ (u_x + i u_y) = κ φ(ζ) + φ(ζ̄) − (ζ − ζ̄) conj φ'(ζ),   φ = C [(ζ − b) ln(ζ − b) − (ζ + b) ln(ζ + b)]
//
// It grows as ln r, so that it is given relative to a point at some depth under the middle, which the scene holds
// fixed.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"

namespace stillpoint {
namespace {

class StripLoad final : public ExactSolution {
  using Complex = std::complex<double>;

 public:
  explicit StripLoad(const Problem& problem)
      : of_(elastic_constants(problem)),
        x0_(parameter(problem, "x0")),
        surface_(parameter(problem, "surface")),
        b_(parameter(problem, "half_width")),
        q_(parameter(problem, "pressure")) {
    at_held_point_ = potential(0, parameter(problem, "fixed_depth"));
  }

  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    const Complex twice_mu_u = potential(X[0] - x0_, depth(X)) - at_held_point_;
    u[0] = twice_mu_u.real() / (2 * of_.mu);
    u[1] = twice_mu_u.imag() / (2 * of_.mu);
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double, std::span<double> sigma) const override {
    const double z = depth(X);
    double angle = 0, sines = 0, shear = 0;
    for (const double sign : {1.0, -1.0}) {
      const double x = X[0] - x0_ + sign * b_, square = x * x + z * z;
      angle += sign * std::atan2(x, z);
      if (square == 0) continue;  // at an end of the strip, where the mean of both sides is taken
      sines += sign * z * x / square;
      shear -= sign * z * z / square;
    }
    const double unit = q_ / std::numbers::pi;
    sigma[0] = -unit * (angle - sines);
    sigma[1] = -unit * (angle + sines);
    sigma[2] = across(of_, sigma[0], sigma[1]);
    sigma[3] = unit * shear;
  }

 private:
  double depth(std::span<const double> X) const { return std::max(surface_ - X[1], 0.0); }

  // 2μ (u_x + i u_y) up to a rigid motion.
  Complex potential(double x, double z) const {
    const Complex C(0, -q_ / (2 * std::numbers::pi));
    const auto phi = [&](const Complex& at) { return C * (product(at - b_) - product(at + b_)); };
    const Complex at(x, z == 0 ? -0.0 : -z);  // below the branch cuts of the logarithms
    // (ζ − ζ̄) conj φ'(ζ) = −2 i z conj φ'; at the ends of the strip, where ln diverges, z is 0
    const Complex correction = z == 0 ? 0 : Complex(0, -2 * z) * std::conj(C * (std::log(at - b_) - std::log(at + b_)));
    return of_.kappa * phi(at) + phi(std::conj(at)) - correction;
  }
  // w ln w, continued by 0 at w = 0.
  static Complex product(const Complex& w) { return w == Complex(0) ? 0 : w * std::log(w); }

  ElasticConstants of_;
  double x0_, surface_, b_;  // [m]
  double q_;                 // [Pa]
  Complex at_held_point_;
};

}  // namespace

KnownSolution strip_load_solution() {
  using enum StressState;
  return {.about = {.name = "strip-load",
                    .description = "a uniform pressure on a strip of the level surface of a half-plane below it",
                    .source = "Boussinesq 1885; Flamant 1892; Timoshenko and Goodier 1970, art. 37",
                    .states = {plane_strain, plane_stress},
                    .parameters = {positive_parameter("pressure", "Pa", "on the strip"),
                                   positive_parameter("half_width", "m", "of the strip"),
                                   positive_parameter("fixed_depth", "m",
                                                      "below the middle of the strip, of the point that stays: "
                                                      "displacements are relative to it"),
                                   any_parameter("x0", "m", "of the middle of the strip"),
                                   any_parameter("surface", "m", "its height, y")}},
          .make = make_solution<StripLoad>};
}

}  // namespace stillpoint
