#include "space/phase/initial_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/throw_scene_error.hpp"
#include "space/materials/material_laws.hpp"
#include "space/points/value_by_place.hpp"
#include "space/points/weight_above.hpp"

namespace stillpoint {
namespace {

/// The positions of the points of material m before the motion, in their order.
template <Kinematics K>
std::vector<std::vector<double>> places(const Body<K>& body, std::size_t m, const std::vector<double>& origin) {
  std::vector<std::vector<double>> all;
  for (int p = body.points.material_begin[m]; p < body.points.material_begin[m + 1]; ++p) {
    auto x = body.points.position(static_cast<std::size_t>(p));
    const auto number = static_cast<std::size_t>(body.points.number[static_cast<std::size_t>(p)]);
    for (std::size_t d = 0; d < x.size() && !origin.empty(); ++d) x[d] = origin[x.size() * number + d];
    all.emplace_back(x.begin(), x.end());
  }
  return all;
}

template <Kinematics K>
void set_geostatic_stress(const Problem& problem, Body<K>& body) {
  if constexpr (dimensions(K) > 1) {
    const GeostaticSpec& level = *problem.geostatic;
    const double b_y = problem.body_force.at(1)({}, 0);
    std::vector<const BodySpec*> bodies;
    for (const BodySpec& spec : problem.bodies) bodies.push_back(&spec);
    const WeightAbove weight_above(problem, bodies, level.surface);
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
      const MaterialSpec& material = problem.materials.at(body.material_names[m]);
      const std::vector<std::vector<double>> at = places(body, m, {});
      InitialGround ground = initial_ground(material, at);
      ground.at_rest = true;
      std::vector<std::array<double, stress_components(K)>> stress;  // the effective one
      for (const std::vector<double>& x : at) {
        const double below = level.water_table.value_or(x[1]) - x[1];
        const double water = material.undrained ? level.water_density * -b_y * std::max(0.0, below) : 0;
        std::ranges::copy(stress_at_rest(level.K0, weight_above(x, material) + water, x, "initial.geostatic.K0"),
                          stress.emplace_back().begin());
        ground.pore_pressure.push_back(water);
      }
      body.materials[m]->set_stress(stress, ground);
    }
  }
}

template <Kinematics K>
void set_uniform_stress(const Problem& problem, Body<K>& body) {
  std::array<double, stress_components(K)> sigma{};
  std::ranges::copy(problem.initial_stress, sigma.begin());
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const std::vector<std::vector<double>> at = places(body, m, {});
    body.materials[m]->set_stress(std::vector(at.size(), sigma),
                                  initial_ground(problem.materials.at(body.material_names[m]), at));
  }
}

/// A law whose stiffness follows the stress can begin neither without pressure nor outside its yield surface.
template <Kinematics K>
void check_initial_stress(const Problem& problem, const Body<K>& body) {
  if constexpr (dimensions(K) > 1) {
    constexpr double rounding = 1e-6;  // of a root of a difference, near the tip of an ellipse
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
      const PointMaterial<K>& material = *body.materials[m];
      if (!material.info().needs_pressure) continue;
      const MaterialSpec& spec = problem.materials.at(body.material_names[m]);
      for (int k = body.points.material_begin[m]; k < body.points.material_begin[m + 1]; ++k) {
        const auto p = static_cast<std::size_t>(k);
        const auto sigma = material.cauchy({}, p);
        const double pressure = -(sigma[0] + sigma[1] + sigma[2]) / 3;
        if (!(pressure > 0))
          throw_scene_error(fmt::format("material.{}.law", spec.name),
                            fmt::format("'{}' has no stiffness without pressure, and the mean pressure at ({:.6g}) is "
                                        "{:.6g} Pa when the run begins; expected one above 0 everywhere",
                                        spec.law, fmt::join(body.points.position(p), ", "), pressure));
        const std::optional<YieldState> at = material.yield_state(p);
        if (at && !(at->f <= rounding * pressure))
          throw_scene_error(
              fmt::format("material.{}.law", spec.name),
              fmt::format("the initial stress at ({:.6g}) lies outside the yield surface of '{}': sqrt(J2) "
                          "is {:.6g} Pa there, and {:.6g} Pa its strength; expected a larger pc or OCR >= 1",
                          fmt::join(body.points.position(p), ", "), spec.law, at->root_J2, at->strength));
      }
    }
  }
}

/// What laws take by place and go on with.
template <Kinematics K>
void set_parameters_by_place(const Problem& problem, Body<K>& body, const std::vector<double>& origin) {
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const MaterialSpec& material = problem.materials.at(body.material_names[m]);
    for (const auto& [name, formula] : material.by_place) {
      const Vec row = body.materials[m]->by_place(name);
      if (!row.empty()) std::ranges::copy(values_by_place(material, name, places(body, m, origin)), row.begin());
    }
  }
}

template <Kinematics K>
void find_smallest_densities(const Problem& problem, Body<K>& body, const std::vector<double>& origin) {
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const MaterialSpec& material = problem.materials.at(body.material_names[m]);
    const std::vector<double> values = material.by_place.contains("rho")
                                           ? values_by_place(material, "rho", places(body, m, origin))
                                           : std::vector<double>();
    body.smallest_density.push_back(values.empty() ? material.parameters.at("rho") : std::ranges::min(values));
  }
}

template <Kinematics K>
void begin_laws(const Problem& problem, Body<K>& body) {
  const double cell = mean_cell(problem.grid);
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const auto begin = static_cast<std::size_t>(body.points.material_begin[m]);
    body.materials[m]->begin([&](std::size_t k) {
      PlaceOfPoint place{.number = body.points.number[begin + k], .cell = cell};
      std::ranges::copy(body.points.position(begin + k), place.position.begin());
      return place;
    });
    // That of this library is made without its viscosity where no time passes.
    if (problem.solve.is_static() && body.materials[m]->info().viscous)
      throw_scene_error(
          "solve.method",
          fmt::format("'{}' has no time, and the law '{}' of material.{} answers to the rate of strain; "
                      "expected solve.method = \"relaxation\"",
                      problem.solve.method, problem.materials.at(body.material_names[m]).law, body.material_names[m]));
  }
}

}  // namespace

template <Kinematics K>
void set_initial_state(const Problem& problem, Body<K>& body, const std::vector<double>& origin) {
  if (problem.geostatic) set_geostatic_stress(problem, body);
  if (!problem.initial_stress.empty()) set_uniform_stress(problem, body);
  set_parameters_by_place(problem, body, origin);
  check_initial_stress(problem, body);
  find_smallest_densities(problem, body, origin);
  begin_laws(problem, body);
}

template <Kinematics K>
std::vector<std::string> notes_on_initial_stress(const Problem& problem, const Body<K>& body) {
  constexpr double rounding = 1e-6;
  std::vector<std::string> notes;
  if (!problem.geostatic && problem.initial_stress.empty()) return notes;
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    double worst = 1 + rounding;  // √J₂ over that which is borne
    std::size_t at = body.points.size();
    YieldState there;
    for (int k = body.points.material_begin[m]; k < body.points.material_begin[m + 1]; ++k) {
      const auto p = static_cast<std::size_t>(k);
      const std::optional<YieldState> state = body.materials[m]->yield_state(p);
      if (!state || !(state->f > 0)) continue;
      const double share =
          state->strength > 0 ? state->root_J2 / state->strength : std::numeric_limits<double>::infinity();
      if (share > worst) worst = share, at = p, there = *state;
    }
    if (at == body.points.size()) continue;
    notes.push_back(fmt::format(
        "the initial stress lies outside the strength of material.{}: at ({:.6g}) sqrt(J2) is {:.6g} Pa, and {}; what "
        "is beyond flows at once, without a load; expected {}",
        body.material_names[m], fmt::join(body.points.position(at), ", "), there.root_J2,
        there.strength > 0 ? fmt::format("{:.6g} Pa its strength", there.strength)
                           : "nothing is borne in so much tension",
        problem.geostatic ? "another K0, or a larger phi or c" : "another initial.stress, or a larger phi or c"));
  }
  return notes;
}

template <Kinematics K>
void set_initial_velocity(const Problem& problem, Body<K>& body) {
  if (problem.initial_v.empty()) return;
  for (std::size_t p = 0; p < body.points.size(); ++p) {
    for (std::size_t i = 0; i < dimensions(K); ++i)
      body.points.v[i][p] = problem.initial_v[i](body.points.position(p), 0);
  }
}

template void set_initial_state(const Problem&, Body<Kinematics::line>&, const std::vector<double>&);
template void set_initial_state(const Problem&, Body<Kinematics::plane>&, const std::vector<double>&);
template void set_initial_state(const Problem&, Body<Kinematics::axisymmetric>&, const std::vector<double>&);
template void set_initial_state(const Problem&, Body<Kinematics::space>&, const std::vector<double>&);
template std::vector<std::string> notes_on_initial_stress(const Problem&, const Body<Kinematics::line>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::line>&);
template std::vector<std::string> notes_on_initial_stress(const Problem&, const Body<Kinematics::plane>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::plane>&);
template std::vector<std::string> notes_on_initial_stress(const Problem&, const Body<Kinematics::axisymmetric>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::axisymmetric>&);
template std::vector<std::string> notes_on_initial_stress(const Problem&, const Body<Kinematics::space>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::space>&);

}  // namespace stillpoint
