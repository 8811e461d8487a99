// A thick-walled cylinder a < r < b under the pressures p_a inside and p_b outside [Lamé and Clapeyron 1831; Timoshenko
// and Goodier 1970, art. 28]:
//
//   σ_rr, σ_θθ = A ∓ B/r²,   2μ u_r = A r (κ − 1)/2 + B/r,
//   A = (p_a a² − p_b b²)/(b² − a²),   B = (p_a − p_b) a² b²/(b² − a²)
//
// with Kolosov's κ; in plane strain and axisymmetric scenes the length of the cylinder is fixed, in plane stress it is
// a ring.
#include <fmt/format.h>

#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"
#include "exact/polar.hpp"

namespace stillpoint {
namespace {

class LameCylinder final : public ExactSolution {
 public:
  explicit LameCylinder(const Problem& problem)
      : of_(elastic_constants(problem)),
        is_around_axis_(problem.state == StressState::axisymmetric),
        centre_{parameter(problem, "x0"), parameter(problem, "y0")} {
    const double a = parameter(problem, "inner_radius"), b = parameter(problem, "outer_radius");
    const double p_a = parameter(problem, "inner_pressure"), p_b = parameter(problem, "outer_pressure");
    const double wall = b * b - a * a;
    A_ = (p_a * a * a - p_b * b * b) / wall;
    B_ = (p_a - p_b) * a * a * b * b / wall;
  }

  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    if (is_around_axis_) {
      u[0] = radial(X[0]);
      u[1] = 0;
      return;
    }
    const PolarPosition at(X, centre_);
    const auto [u_x, u_y] = at.cartesian(radial(at.r), 0);
    u[0] = u_x;
    u[1] = u_y;
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double, std::span<double> sigma) const override {
    const double zz = across(of_, A_, A_);  // σ_rr + σ_θθ = 2 A
    if (is_around_axis_) {
      const double of_radius = B_ / (X[0] * X[0]);
      sigma[0] = A_ - of_radius;
      sigma[1] = zz;
      sigma[2] = A_ + of_radius;
      sigma[3] = 0;
      return;
    }
    const PolarPosition at(X, centre_);
    const double of_radius = B_ / (at.r * at.r);
    const auto [xx, yy, xy] = at.cartesian(A_ - of_radius, A_ + of_radius, 0);
    sigma[0] = xx;
    sigma[1] = yy;
    sigma[2] = zz;
    sigma[3] = xy;
  }

 private:
  double radial(double r) const { return (A_ * r * (of_.kappa - 1) / 2 + B_ / r) / (2 * of_.mu); }

  ElasticConstants of_;
  bool is_around_axis_;
  std::array<double, 2> centre_;  // [m]
  double A_ = 0, B_ = 0;          // [Pa], [N]
};

std::optional<SolutionFault> lame_cylinder_fault(const Problem& problem) {
  const double a = parameter(problem, "inner_radius"), b = parameter(problem, "outer_radius");
  if (!(b > a))
    return SolutionFault{"outer_radius", fmt::format("must be greater than exact.inner_radius = {}, not {}", a, b)};
  return fault_of_centre(problem);
}

}  // namespace

KnownSolution lame_cylinder_solution() {
  using enum StressState;
  return {.about = {.name = "lame-cylinder",
                    .description = "a thick-walled cylinder under pressure, held in length; in plane stress a ring",
                    .source = "Lame and Clapeyron 1831; Timoshenko and Goodier 1970, art. 28",
                    .states = {plane_strain, plane_stress, axisymmetric},
                    .parameters = {positive_parameter("inner_radius", "m", "where the inner pressure acts"),
                                   positive_parameter("outer_radius", "m", "where the outer pressure acts"),
                                   any_parameter("inner_pressure", "Pa", "on the inside"),
                                   any_parameter("outer_pressure", "Pa", "on the outside"),
                                   any_parameter("x0", "m", "of the centre, in a plane"),
                                   any_parameter("y0", "m", "likewise")},
                    .fault = lame_cylinder_fault},
          .make = make_solution<LameCylinder>};
}

}  // namespace stillpoint
