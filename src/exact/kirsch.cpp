// A circular hole in an infinite plate under far tensions S_x and S_y [Kirsch 1898; Timoshenko and Goodier 1970, art.
// 35]. With m = (S_x + S_y)/2, d = (S_x − S_y)/2 and q = a/r:
//
//   σ_rr = m (1 − q²) + d (1 − 4q² + 3q⁴) cos 2θ
//   σ_θθ = m (1 + q²) − d (1 + 3q⁴) cos 2θ
//   σ_rθ = −d (1 + 2q² − 3q⁴) sin 2θ
//   2μ u_r = r [m ((κ − 1)/2 + q²) + d (1 + (1 + κ) q² − q⁴) cos 2θ]
//   2μ u_θ = −r d (1 + (κ − 1) q² + q⁴) sin 2θ
#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"
#include "exact/polar.hpp"

namespace stillpoint {
namespace {

class Kirsch final : public ExactSolution {
 public:
  explicit Kirsch(const Problem& problem)
      : of_(elastic_constants(problem)),
        centre_{parameter(problem, "x0"), parameter(problem, "y0")},
        a_(parameter(problem, "radius")),
        mean_((parameter(problem, "tension_x") + parameter(problem, "tension_y")) / 2),
        deviation_((parameter(problem, "tension_x") - parameter(problem, "tension_y")) / 2) {}

  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    const PolarPosition at(X, centre_);
    const double q2 = a_ * a_ / (at.r * at.r), q4 = q2 * q2, unit = at.r / (2 * of_.mu);
    const double isotropic = mean_ * ((of_.kappa - 1) / 2 + q2);
    const double u_r = unit * (isotropic + deviation_ * (1 + (1 + of_.kappa) * q2 - q4) * at.cos_2());
    const double u_theta = -unit * deviation_ * (1 + (of_.kappa - 1) * q2 + q4) * at.sin_2();
    const auto [u_x, u_y] = at.cartesian(u_r, u_theta);
    u[0] = u_x;
    u[1] = u_y;
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double, std::span<double> sigma) const override {
    const PolarPosition at(X, centre_);
    const double q2 = a_ * a_ / (at.r * at.r), q4 = q2 * q2;
    const double rr = mean_ * (1 - q2) + deviation_ * (1 - 4 * q2 + 3 * q4) * at.cos_2();
    const double theta_theta = mean_ * (1 + q2) - deviation_ * (1 + 3 * q4) * at.cos_2();
    const double r_theta = -deviation_ * (1 + 2 * q2 - 3 * q4) * at.sin_2();
    const auto [xx, yy, xy] = at.cartesian(rr, theta_theta, r_theta);
    sigma[0] = xx;
    sigma[1] = yy;
    sigma[2] = across(of_, xx, yy);
    sigma[3] = xy;
  }

 private:
  ElasticConstants of_;
  std::array<double, 2> centre_;  // [m]
  double a_;                      // [m]
  double mean_, deviation_;       // m and d [Pa]
};

std::optional<SolutionFault> kirsch_fault(const Problem& problem) {
  if (parameter(problem, "tension_x") != 0 || parameter(problem, "tension_y") != 0) return std::nullopt;
  return SolutionFault{"solution", "needs tension_x or tension_y, the tension far from the hole"};
}

}  // namespace

KnownSolution kirsch_solution() {
  using enum StressState;
  return {.about = {.name = "kirsch",
                    .description = "a circular hole in an infinite plate under tension far from it",
                    .source = "Kirsch 1898; Timoshenko and Goodier 1970, art. 35",
                    .states = {plane_strain, plane_stress},
                    .parameters = {positive_parameter("radius", "m", "of the hole"),
                                   any_parameter("tension_x", "Pa", "along x, far from the hole"),
                                   any_parameter("tension_y", "Pa", "along y"),
                                   any_parameter("x0", "m", "of its centre"), any_parameter("y0", "m", "likewise")},
                    .fault = kirsch_fault},
          .make = make_solution<Kirsch>};
}

}  // namespace stillpoint
