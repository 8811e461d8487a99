// A slender cantilever under a load P at its tip that keeps its direction, bent without stretch or shear [Bisshopp and
// Drucker 1945, Q. Appl. Math. 3:272-275]. With θ the slope of the axis towards the load, β² = P/(E I), and
// 1 + sin θ = 2 k² sin² φ:
//
//   E I θ'' = −P cos θ,   θ(0) = 0,   θ'(L) = 0
//   β s = F(φ, k) − F(φ_0, k),   sin φ_0 = 1/(k √2),   φ(L) = π/2:   K(k) − F(φ_0, k) = β L gives k
//   along the beam   x = (2k/β) (cos φ_0 − cos φ)
//   with the load    w = [F(φ) − F(φ_0) − 2 (E(φ) − E(φ_0))]/β
//
// with the elliptic integrals F, E, K of modulus k. Sections stay plane and normal to the axis: the point at s and at η
// from the axis moves by
//
//   u_x = x − s + η sin θ,   u_y = −w + η (cos θ − 1).
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/special_functions.hpp"
#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"

namespace stillpoint {
namespace {

class Elastica final : public ExactSolution {
 public:
  explicit Elastica(const Problem& problem)
      : clamped_(parameter(problem, "x0")), axis_(parameter(problem, "y0")), length_(parameter(problem, "length")) {
    const ElasticConstants of = elastic_constants(problem);
    const double depth = parameter(problem, "depth");
    const double bending = (of.is_plane_stress ? of.E : of.E / (1 - of.nu * of.nu)) * problem.bodies.front().area *
                           depth * depth * depth / 12;  // E I [N m²]
    beta_ = std::sqrt(parameter(problem, "load") / bending);
    const auto start = [](double k) { return std::asin(std::min(1.0, std::numbers::sqrt2 / (2 * k))); };
    // k goes from 1/√2, without a load, to 1; the load at a k that rounding separates from 1 is some hundred times
    // E I/L².
    k_ = zero_between(std::numbers::sqrt2 / 2, 1 - 1e-15,
                      [&](double k) { return elliptic_k(k) - elliptic_f(start(k), k) - beta_ * length_; });
    phi_0_ = start(k_);
    F_0_ = elliptic_f(phi_0_, k_);
    E_0_ = elliptic_e(phi_0_, k_);
  }

  // Beyond its ends the axis continues as a straight line.
  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    const double s = X[0] - clamped_, eta = X[1] - axis_, within = std::clamp(s, 0.0, length_);
    const auto [sn, cn] = jacobi(F_0_ + beta_ * within, k_);
    const double phi = std::atan2(sn, cn);
    const double sin_theta = std::min(1.0, 2 * k_ * k_ * sn * sn - 1), cos_theta = std::sqrt(1 - sin_theta * sin_theta);
    const double x = 2 * k_ / beta_ * (std::cos(phi_0_) - cn) + (s - within) * cos_theta;
    const double w =
        within - 2 / beta_ * (elliptic_e(phi, k_) - E_0_) + (s - within) * sin_theta;  // F(φ) − F(φ_0) = β s
    u[0] = x - s + eta * sin_theta;
    u[1] = -w + eta * (cos_theta - 1);
  }
  bool has_stress() const override { return false; }
  void stress(std::span<const double>, double, std::span<double>) const override {}

 private:
  double clamped_, axis_;  // x and y [m]
  double length_;          // [m]
  double beta_ = 0;        // [1/m]
  double k_ = 0, phi_0_ = 0, F_0_ = 0, E_0_ = 0;
};

std::optional<SolutionFault> elastica_fault(const Problem& problem) {
  constexpr double least = 1e-3, most = 200;  // within them nothing cancels and k < 1
  const ElasticConstants of = elastic_constants(problem);
  const double depth = parameter(problem, "depth"), length = parameter(problem, "length");
  const double modulus = of.is_plane_stress ? of.E : of.E / (1 - of.nu * of.nu);
  const double of_bending = parameter(problem, "load") * length * length * 12 /
                            (modulus * problem.bodies.front().area * depth * depth * depth);
  if (of_bending >= least && of_bending <= most) return std::nullopt;
  return SolutionFault{
      "load", fmt::format("is {:g} times E I/L^2; expected from {:g} to {:g} times that", of_bending, least, most)};
}

}  // namespace

KnownSolution elastica_solution() {
  using enum StressState;
  return {
      .about = {.name = "elastica",
                .description = "a slender cantilever along x, clamped at x0, under a load at its tip along -y that "
                               "keeps its direction; displacement alone",
                .source = "Bisshopp and Drucker 1945, by elliptic integrals",
                .states = {plane_strain, plane_stress},
                .parameters = {positive_parameter("length", "m", "of the beam"),
                               positive_parameter("depth", "m", "of its section, along y"),
                               positive_parameter("load", "N", "at the tip, along -y, over the body's thickness"),
                               any_parameter("x0", "m", "of the clamped end"), any_parameter("y0", "m", "of the axis")},
                .has_stress = false,
                .fault = elastica_fault},
      .make = make_solution<Elastica>};
}

}  // namespace stillpoint
