#include "space/phase/initial_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/gauss_rule.hpp"
#include "scene/body_depth.hpp"
#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/materials/material_laws.hpp"
#include "space/points/value_by_place.hpp"

namespace stillpoint {
namespace {

/// The vertical stress by the weight above a position.
class WeightAbove {
 public:
  /// b_y: the body force [m/s²].
  WeightAbove(const Problem& problem, double b_y)
      : problem_(problem),
        b_y_(b_y),
        step_(touching * smallest_cell(problem.grid, 1)),
        lines_(grid_lines(problem.grid, 1)) {
    for (const BodySpec& body : problem.bodies) {
      depths_.emplace_back(body);
      materials_.push_back(&problem.materials.at(body.material));
    }
    const double first = materials_.front()->parameters.at("rho");
    by_depth_ = std::ranges::all_of(materials_,
                                    [&](const MaterialSpec* one) {
                                      return !one->by_place.contains("rho") && one->parameters.at("rho") == first;
                                    }) ||
                std::ranges::any_of(depths_, [](const BodyDepth& depth) { return !depth.is_known(); });
  }

  /// of: the material of the point itself, which is all that counts above it where the ground has one density, or the
  /// surface of a body is not known [Pa].
  double operator()(std::vector<double> X, const MaterialSpec& of) const {
    const double surface = problem_.geostatic->surface;
    const MaterialSpec* last = &of;
    double weight = 0, from = X[1];
    for (std::optional<std::size_t> k = by_depth_ ? std::nullopt : body_at(X); k && X[1] < surface; k = body_at(X)) {
      const double rest = surface - X[1],
                   up = std::clamp(depths_[*k].along(X, 1, true, rest).value_or(rest), 0.0, rest);
      const double to = X[1] + up;
      last = materials_[*k];
      weight += column(*last, X, from, to);
      from = to;
      X[1] = to + step_;
    }
    return weight + column(*last, X, from, surface);
  }

 private:
  std::optional<std::size_t> body_at(const std::vector<double>& X) const {
    for (std::size_t k = 0; k < depths_.size(); ++k)
      if (depths_[k].contains(X)) return k;
    return std::nullopt;
  }
  // ∫ ρ b_y dy of a material along the vertical through X. A formula is integrated from one line of the grid to the
  // next, where layers end, by a rule that is exact for polynomials up to the fifth degree.
  double column(const MaterialSpec& material, std::vector<double> X, double from, double top) const {
    if (!material.by_place.contains("rho")) return material.parameters.at("rho") * b_y_ * std::max(0.0, top - from);
    double weight = 0;
    while (from < top) {
      const auto next = std::ranges::upper_bound(lines_, from);
      const double to = next == lines_.end() ? top : std::min(*next, top);
      const GaussRule rule(from, to, 3);
      for (std::size_t i = 0; i < rule.at.size(); ++i) {
        X[1] = rule.at[i];
        weight += rule.weight[i] * b_y_ * value_by_place(material, "rho", X);
      }
      from = to;
    }
    return weight;
  }

  const Problem& problem_;
  double b_y_;
  double step_;  // over the border of a body [m]
  std::vector<double> lines_;
  std::vector<BodyDepth> depths_;
  std::vector<const MaterialSpec*> materials_;  // of the bodies
  bool by_depth_ = true;
};

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
    const WeightAbove weight_above(problem, b_y);
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
      const MaterialSpec& material = problem.materials.at(body.material_names[m]);
      const std::vector<std::vector<double>> at = places(body, m, {});
      InitialGround ground = initial_ground(material, at);
      ground.at_rest = true;
      std::vector<std::array<double, stress_components(K)>> stress;  // the effective one
      for (const std::vector<double>& x : at) {
        const double below = level.water_table.value_or(x[1]) - x[1];
        const double water = material.undrained ? level.water_density * -b_y * std::max(0.0, below) : 0;
        const double vertical = weight_above(x, material) + water, K0 = level.K0(x, 0);
        if (!(K0 > 0) || !std::isfinite(K0))
          throw_scene_error("initial.geostatic.K0",
                            fmt::format("must be > 0 everywhere, not {} at ({:.6g})", K0, fmt::join(x, ", ")));
        stress.push_back({K0 * vertical, vertical, K0 * vertical});
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
template void set_initial_velocity(const Problem&, Body<Kinematics::line>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::plane>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::axisymmetric>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::space>&);

}  // namespace stillpoint
