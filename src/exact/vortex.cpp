// A generalised vortex: in a ring R_1 < R < R_2 each circle rotates as a whole, and nothing moves outside the ring
// [after Kamojjala, Brannon, Sadeghirad and Guilkey 2015, Eng. Comput. 31:193-213]:
//
//   x = Q(α(R)) X,   α = A (1 − s²)ⁿ,   s = (2R − R_1 − R_2)/(R_2 − R_1)
//
// or the whole of a disc R < R_2 with s = R/R_2, for which α is as smooth at the centre as anywhere. The motion
// preserves volume. For the neo-Hookean law, in the directions of the angle Θ + α and with γ = R α':
//
//   σ_rθ = μ γ,   σ_θθ = μ γ²,   σ_rr = σ_zz = 0
//
// which is in equilibrium with the body force
//
//   ρ b = μ R α'² e_r − μ (3 α' + R α'') e_θ.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"
#include "exact/polar.hpp"

namespace stillpoint {
namespace {

class Vortex final : public ExactSolution {
 public:
  explicit Vortex(const Problem& problem)
      : mu_(elastic_constants(problem).mu),
        centre_{parameter(problem, "x0"), parameter(problem, "y0")},
        middle_(is_disc(problem) ? 0 : (parameter(problem, "inner_radius") + parameter(problem, "outer_radius")) / 2),
        half_(parameter(problem, "outer_radius") - middle_),
        A_(parameter(problem, "angle")),
        n_(parameter(problem, "power")) {}

  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    const PolarPosition at(X, centre_);
    const double angle = angle_at(at.r).first;
    // Q − I by half the angle, so that a small one keeps its digits
    const double c = -2 * std::sin(angle / 2) * std::sin(angle / 2), s = std::sin(angle);
    const double x = at.r * at.cos, y = at.r * at.sin;
    u[0] = c * x - s * y;
    u[1] = s * x + c * y;
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double, std::span<double> sigma) const override {
    PolarPosition at(X, centre_);
    const auto [angle, slope] = angle_at(at.r);
    const double gamma = at.r * slope, c = std::cos(angle), s = std::sin(angle);
    const double cosine = at.cos * c - at.sin * s;
    at.sin = at.sin * c + at.cos * s;
    at.cos = cosine;
    const auto [xx, yy, xy] = at.cartesian(0, mu_ * gamma * gamma, mu_ * gamma);
    sigma[0] = xx;
    sigma[1] = yy;
    sigma[2] = 0;
    sigma[3] = xy;
  }

 private:
  static bool is_disc(const Problem& problem) { return parameter(problem, "inner_radius") == 0; }
  // α and α' at R.
  std::pair<double, double> angle_at(double R) const {
    const double s = (R - middle_) / half_, q = 1 - s * s;
    if (!(q > 0)) return {0, 0};
    return {A_ * std::pow(q, n_), -2 * n_ * A_ * s / half_ * std::pow(q, n_ - 1)};
  }

  double mu_;                     // [Pa]
  std::array<double, 2> centre_;  // [m]
  double middle_, half_;          // of the ring; for a disc 0 and R_2 [m]
  double A_, n_;
};

std::optional<SolutionFault> vortex_fault(const Problem& problem) {
  const double inner = parameter(problem, "inner_radius"), outer = parameter(problem, "outer_radius");
  if (outer > inner) return std::nullopt;
  return SolutionFault{"outer_radius",
                       fmt::format("must be greater than exact.inner_radius = {}, not {}", inner, outer)};
}

}  // namespace

KnownSolution vortex_solution() {
  using enum StressState;
  ParameterInfo power = positive_parameter("power", "1", "n of the angle A (1 - s^2)^n; 2 is that of the paper");
  power.lower = 2;
  power.lower_allowed = true;
  power.required = false;
  power.fallback = 3;
  ParameterInfo inner_radius = positive_parameter("inner_radius", "m", "R_1 of the ring; 0: a disc, s = R/R_2");
  inner_radius.lower_allowed = true;
  inner_radius.required = false;
  ParameterInfo angle = any_parameter("angle", "rad", "A, by which the middle of the ring or disc turns");
  angle.required = true;
  return {.about = {.name = "vortex",
                    .description = "a ring or disc that turns inside itself, under rho b = mu R alpha'^2 e_r - mu (3 "
                                   "alpha' + R alpha'') e_theta",
                    .source = "after Kamojjala, Brannon, Sadeghirad and Guilkey 2015",
                    .states = {plane_strain},
                    .parameters = {inner_radius, positive_parameter("outer_radius", "m", "R_2"), angle, power,
                                   any_parameter("x0", "m", "of its centre"), any_parameter("y0", "m", "likewise")},
                    .laws = {"neo-hookean"},
                    .fault = vortex_fault},
          .make = make_solution<Vortex>};
}

}  // namespace stillpoint
