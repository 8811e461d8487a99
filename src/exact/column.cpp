// A confined column under its own weight, 0 < s < h, fixed at s = 0 and free at s = h:
//
//   P(F(s)) = −ρ g (h − s),   u(s) = ∫₀ˢ (F − 1) ds
//
// With e = ln F and the energy W(F), dW = P dF, the integral has a closed form, as ds = dP/(ρ g):
//
//   u(s) = [(F − 1) P − W] between 0 and s, over ρ g
//
//   linear elastic   P = M (F − 1)                      F − 1 = −p/M,  p = ρ g (h − s),  M = λ + 2μ
//   Hencky           P = M e/F,  W = M e²/2             e = −W_0(p/M)  (Lambert's W)
//   neo-Hookean      P = μ (F − 1/F) + λ e/F,  W = μ ((F² − 1)/2 − e) + λ e²/2
//
// The section keeps its width, so that the Cauchy stress along the column is −p for each of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "base/special_functions.hpp"
#include "exact/known_solutions.hpp"
#include "exact/of_scene.hpp"
#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

double modulus(const ElasticConstants& of) { return of.lambda + 2 * of.mu; }

/// The response of a law to the pressure p at a section [Pa].
struct ColumnLaw {
  std::string_view name;
  bool finite_strain;
  double (*strain)(const ElasticConstants&, double p);  // e, or F − 1 at small strain
  double (*energy)(const ElasticConstants&, double e);  // W [Pa]
};

constexpr std::array<ColumnLaw, 3> kColumnLaws = {{
    {"linear-elastic", false, [](const ElasticConstants& of, double p) { return -p / modulus(of); },
     [](const ElasticConstants& of, double e) { return modulus(of) * e * e / 2; }},
    {"hencky", true, [](const ElasticConstants& of, double p) { return -lambert_w(p / modulus(of)); },
     [](const ElasticConstants& of, double e) { return modulus(of) * e * e / 2; }},
    {"neo-hookean", true,
     [](const ElasticConstants& of, double p) {
       // μ (F − 1/F) + λ e/F + p
       const auto excess = [&](double e) { return 2 * of.mu * std::sinh(e) + of.lambda * e * std::exp(-e) + p; };
       double lower = -0.5;
       while (excess(lower) > 0 && lower > -100) lower *= 1.5;
       return zero_between(lower, 0.5, excess);
     },
     // (F² − 1)/2 − e = e² (e^{2e} − 1 − 2e)/(2e²)
     [](const ElasticConstants& of, double e) {
       return of.mu * e * e * relative_exponential_2(2 * e) + of.lambda * e * e / 2;
     }},
}};

class Column final : public ExactSolution {
 public:
  explicit Column(const Problem& problem)
      : of_(elastic_constants(problem)),
        law_(*std::ranges::find(kColumnLaws, material_of(problem).law, &ColumnLaw::name)),
        vertical_(dimension_info(problem.dim).vertical),
        base_(parameter(problem, "base")),
        height_(parameter(problem, "height")),
        weight_(of_.rho * parameter(problem, "g")) {
    if (problem.state == StressState::uniaxial_stress) of_.lambda = 0, of_.mu = of_.E / 2;  // free to contract sideways
    at_base_ = settlement(weight_ * height_);
  }

  void displacement(std::span<const double> X, double, std::span<double> u) const override {
    std::ranges::fill(u, 0.0);
    u[vertical_] = (settlement(pressure(X)) - at_base_) / weight_;
  }
  bool has_stress() const override { return true; }
  void stress(std::span<const double> X, double, std::span<double> sigma) const override {
    const double p = pressure(X);
    if (sigma.size() == 1) {
      sigma[0] = -p;
      return;
    }
    const double e = law_.strain(of_, p);
    sigma[0] = sigma[2] = of_.lambda * (law_.finite_strain ? e * std::exp(-e) : e);  // λ ln J/J
    sigma[1] = -p;
    std::fill(sigma.begin() + 3, sigma.end(), 0.0);
  }

 private:
  double pressure(std::span<const double> X) const { return weight_ * (height_ - (X[vertical_] - base_)); }

  // (F − 1) P − W under the pressure p [Pa].
  double settlement(double p) const {
    const double e = law_.strain(of_, p);
    return -(law_.finite_strain ? std::expm1(e) : e) * p - law_.energy(of_, e);
  }

  ElasticConstants of_;
  const ColumnLaw& law_;
  std::size_t vertical_;
  double base_, height_;  // [m]
  double weight_;         // ρ g [N/m³]
  double at_base_ = 0;    // (F − 1) P − W [Pa]
};

// Checks that the body is the column that the parameters describe: boxes and polygons from its base to its top.
std::optional<SolutionFault> fault_of_height(const Problem& problem) {
  const double base = parameter(problem, "base"), height = parameter(problem, "height");
  const auto extent = extent_along(problem, dimension_info(problem.dim).vertical);
  if (!extent || reaches(*extent, base, height)) return std::nullopt;
  return SolutionFault{
      "height", fmt::format("the body reaches from {:g} to {:g}, the column from {:g} to {:g}; give its base and "
                            "height",
                            extent->first, extent->second, base, base + height)};
}

std::optional<SolutionFault> column_fault(const Problem& problem) {
  const auto law = std::ranges::find(kColumnLaws, material_of(problem).law, &ColumnLaw::name);
  if (problem.state == StressState::uniaxial_stress && law->finite_strain && elastic_constants(problem).nu != 0)
    return SolutionFault{"solution",
                         "is of a confined column; in uniaxial stress a section changes, so that it holds for nu = 0 "
                         "alone; take state = \"uniaxial-strain\""};
  return fault_of_height(problem);
}

}  // namespace

KnownSolution column_solution() {
  using enum StressState;
  return {.about = {.name = "column",
                    .description = "a confined column under its own weight, fixed at its base and free at its top: "
                                   "along x in one dimension, otherwise along y",
                    .source = "P(F) = -rho g (h - s); by Lambert's W for Hencky's law",
                    .states = {uniaxial_stress, uniaxial_strain, plane_strain, axisymmetric, space},
                    .parameters = {positive_parameter("height", "m", "of the column before it settles"),
                                   positive_parameter("g", "m/s2", "weight per mass, towards the base"),
                                   any_parameter("base", "m", "position of the base along the column")},
                    .laws = {kColumnLaws[0].name, kColumnLaws[1].name, kColumnLaws[2].name},
                    .fault = column_fault},
          .make = make_solution<Column>};
}

}  // namespace stillpoint
