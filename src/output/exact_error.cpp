#include "output/exact_error.hpp"

#include <stillpoint/exact_solution.hpp>
#include <stillpoint/material.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/pore_water.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {
namespace {

// Σ V |a − b|², Σ V |b|² and the largest |a − b| and |b|, gathered point by point.
struct Norms {
  double difference = 0, exact = 0, max_difference = 0, max_exact = 0;
  void add(double V, double value, double expected) {
    difference += V * (value - expected) * (value - expected);
    exact += V * expected * expected;
    max_difference = std::max(max_difference, std::abs(value - expected));
    max_exact = std::max(max_exact, std::abs(expected));
  }
  double rel_l2() const { return std::sqrt(difference / exact); }
};

/// Calls visit(p, σ_h − σ, σ) for every material point.
template <class Visit>
void for_stresses(const ExactSolution& solution, const LagrangianPhase& phase, const PointData& data, double t,
                  ConstVec u, const Visit& visit) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  const auto components = static_cast<std::size_t>(phase.info().stress_components);
  std::vector<double> stress(components * phase.points()), exact(components), difference(components);
  phase.fields().point_stress(t, u, stress);
  for (std::size_t p = 0; p < phase.points(); ++p) {
    solution.stress({data.positions.data() + dim * p, dim}, t, exact);
    for (std::size_t i = 0; i < components; ++i) difference[i] = stress[components * p + i] - exact[i];
    visit(p, difference, exact);
  }
}

// σ:C⁻¹:σ = [(1 + ν) σ:σ − ν (tr σ)²]/E in space, and in the plane, in which σ_zz does no work; on a line σ²/E if the
// section is free to contract, else σ²/(λ + 2μ).
double energy(const MaterialSpec& material, StressState state, std::span<const double> sigma) {
  const auto [E, nu] = with_water(material);
  if (state == StressState::uniaxial_stress) return contracted(sigma) / E;
  if (state == StressState::uniaxial_strain) {
    const auto [lambda, mu] = LameParameters::from(E, nu);
    return contracted(sigma) / (lambda + 2 * mu);
  }
  const double trace = sigma[0] + sigma[1] + sigma[2];
  return ((1 + nu) * contracted(sigma) - nu * trace * trace) / E;
}

}  // namespace

double contracted(std::span<const double> sigma) {
  double sum = 0;
  for (std::size_t k = 0; k < sigma.size(); ++k) sum += (k < 3 ? 1 : 2) * sigma[k] * sigma[k];
  return sum;
}

std::optional<ExactError> exact_error(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  const auto solution = exact_solution(problem);
  if (!solution) return std::nullopt;
  const auto dim = static_cast<std::size_t>(phase.dim());
  std::vector<double> displacement(dim * phase.points()), exact_u(dim);
  phase.fields().point_displacement(t, u, displacement);
  const PointData data = phase.fields().point_data();
  Norms in_u;
  for (std::size_t p = 0; p < phase.points(); ++p) {
    solution->displacement({data.positions.data() + dim * p, dim}, t, exact_u);
    for (std::size_t i = 0; i < dim; ++i) in_u.add(data.volumes[p], displacement[dim * p + i], exact_u[i]);
  }
  if (in_u.exact == 0) return std::nullopt;
  ExactError error{.u_rel_l2 = in_u.rel_l2(), .u_rel_max = in_u.max_difference / in_u.max_exact, .stress_rel_l2 = {}};
  if (!solution->has_stress()) return error;
  double difference = 0, exact = 0;
  for_stresses(*solution, phase, data, t, u, [&](std::size_t p, ConstVec off, ConstVec sigma) {
    difference += data.volumes[p] * contracted(off);
    exact += data.volumes[p] * contracted(sigma);
  });
  if (exact > 0) error.stress_rel_l2 = std::sqrt(difference / exact);
  return error;
}

EnergyError energy_error(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  const auto solution = exact_solution(problem);
  if (!solution || !solution->has_stress())
    return {{}, "the scene has no exact stress; expected exact.stress, or a solution that has it"};
  std::set<std::string> names;
  for (const BodySpec& body : problem.bodies) names.insert(body.material);
  std::vector<const MaterialSpec*> materials;  // by number, in the order of the names of the materials that bodies have
  for (const std::string& name : names) {
    const MaterialSpec& material = problem.materials.at(name);
    const LawInfo& law = *std::ranges::find(material_laws(), material.law, &LawInfo::name);
    if (law.finite_strain || law.history_dependent)
      return {{}, fmt::format("it is of linear elasticity, and {} is {}", name, material.law)};
    if (material.by_place.contains("E"))
      return {{}, fmt::format("it is of materials of one stiffness, and E of {} varies from place to place", name)};
    materials.push_back(&material);
  }
  double difference = 0, exact = 0;
  const PointData data = phase.fields().point_data();
  for_stresses(*solution, phase, data, t, u, [&](std::size_t p, ConstVec off, ConstVec sigma) {
    const MaterialSpec& material = *materials[static_cast<std::size_t>(data.materials[p])];
    difference += data.volumes[p] * energy(material, problem.state, off);
    exact += data.volumes[p] * energy(material, problem.state, sigma);
  });
  if (!(exact > 0)) return {{}, "the exact stress has no energy"};
  return {std::sqrt(difference / exact), ""};
}

}  // namespace stillpoint
