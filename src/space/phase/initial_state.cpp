#include "space/phase/initial_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/body_depth.hpp"
#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {
namespace {

/// The mass above a position, per area.
class MassAbove {
 public:
  explicit MassAbove(const Problem& problem) : problem_(problem), step_(touching * smallest_cell(problem.grid, 1)) {
    for (const BodySpec& body : problem.bodies) {
      depths_.emplace_back(body);
      densities_.push_back(problem.materials.at(body.material).parameters.at("rho"));
    }
    by_depth_ = std::ranges::adjacent_find(densities_, std::ranges::not_equal_to()) == densities_.end() ||
                std::ranges::any_of(depths_, [](const BodyDepth& depth) { return !depth.is_known(); });
  }

  /// Whether the depth of a point and its own density are all that counts: the ground has one density, or the surface
  /// of a body is not known.
  bool by_depth() const { return by_depth_; }
  /// of: the density of the point itself [kg/m³].
  double operator()(std::vector<double> X, double of) const {
    const double surface = problem_.geostatic->surface;
    double mass = 0;
    for (std::optional<std::size_t> k = body_at(X); k && X[1] < surface; k = body_at(X)) {
      const double rest = surface - X[1],
                   up = std::clamp(depths_[*k].along(X, 1, true, rest).value_or(rest), 0.0, rest);
      of = densities_[*k];
      mass += of * (up + step_);
      X[1] += up + step_;
    }
    return mass + of * (surface - X[1]);
  }

 private:
  std::optional<std::size_t> body_at(const std::vector<double>& X) const {
    for (std::size_t k = 0; k < depths_.size(); ++k)
      if (depths_[k].contains(X)) return k;
    return std::nullopt;
  }

  const Problem& problem_;
  double step_;  // over the border of a body [m]
  std::vector<BodyDepth> depths_;
  std::vector<double> densities_;
  bool by_depth_ = true;
};

/// The values of the parameter of material m that is a formula of the position, at its points; empty: there is none.
template <Kinematics K>
std::vector<double> values_by_place(const Problem& problem, const Body<K>& body, std::size_t m,
                                    const std::vector<double>& origin) {
  const MaterialSpec& material = problem.materials.at(body.material_names[m]);
  const auto law = std::ranges::find(material_laws(), material.law, &LawInfo::name);
  std::vector<double> values;
  for (const auto& [name, formula] : material.by_place) {
    const auto parameter = std::ranges::find(law->parameters, name, &ParameterInfo::name);
    for (int p = body.points.material_begin[m]; p < body.points.material_begin[m + 1]; ++p) {
      auto x = body.points.position(static_cast<std::size_t>(p));
      const auto number = static_cast<std::size_t>(body.points.number[static_cast<std::size_t>(p)]);
      for (std::size_t d = 0; d < x.size() && !origin.empty(); ++d) x[d] = origin[x.size() * number + d];
      const double value = formula(x, 0);
      const bool is_above = parameter->lower_allowed ? value >= parameter->lower : value > parameter->lower;
      if (!is_above || !std::isfinite(value))
        throw_scene_error(
            fmt::format("material.{}.{}", material.name, name),
            fmt::format("must be {} {} everywhere, not {} at ({:.6g})", parameter->lower_allowed ? ">=" : ">",
                        parameter->lower, value, fmt::join(x, ", ")));
      values.push_back(value);
    }
  }
  return values;
}

/// What a law takes by place and not as a strength is a factor of its initial state.
template <Kinematics K>
InitialGround initial_ground(const Problem& problem, const Body<K>& body, std::size_t m, bool at_rest,
                             const std::vector<double>& origin) {
  if (!body.materials[m]->strength_shares().empty()) return {.at_rest = at_rest};
  return {.at_rest = at_rest, .factors = values_by_place(problem, body, m, origin)};
}

template <Kinematics K>
void set_geostatic_stress(const Problem& problem, Body<K>& body, const std::vector<double>& origin) {
  if constexpr (dimensions(K) > 1) {
    const double b_y = problem.body_force.at(1)({}, 0);
    const MassAbove mass_above(problem);
    for (std::size_t m = 0; m < body.materials.size(); ++m) {
      const double rho = problem.materials.at(body.material_names[m]).parameters.at("rho");
      std::vector<std::array<double, stress_components(K)>> stress;
      for (int p = body.points.material_begin[m]; p < body.points.material_begin[m + 1]; ++p) {
        const auto x = body.points.position(static_cast<std::size_t>(p));
        const double depth = problem.geostatic->surface - x[1];
        const double vertical =
            mass_above.by_depth() ? rho * b_y * std::max(0.0, depth) : b_y * mass_above({x.begin(), x.end()}, rho);
        const double side = problem.geostatic->K0 * vertical;
        stress.push_back({side, vertical, side});
      }
      body.materials[m]->set_stress(stress, initial_ground(problem, body, m, /*at_rest=*/true, origin));
    }
  }
}

template <Kinematics K>
void set_uniform_stress(const Problem& problem, Body<K>& body, const std::vector<double>& origin) {
  std::array<double, stress_components(K)> sigma{};
  std::ranges::copy(problem.initial_stress, sigma.begin());
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const int count = body.points.material_begin[m + 1] - body.points.material_begin[m];
    body.materials[m]->set_stress(std::vector(static_cast<std::size_t>(count), sigma),
                                  initial_ground(problem, body, m, /*at_rest=*/false, origin));
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

template <Kinematics K>
void set_strength_by_place(const Problem& problem, Body<K>& body, const std::vector<double>& origin) {
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const Vec shares = body.materials[m]->strength_shares();
    if (!shares.empty()) std::ranges::copy(values_by_place(problem, body, m, origin), shares.begin());
  }
}

template <Kinematics K>
void begin_laws(const Problem& problem, Body<K>& body) {
  double cell = 1;
  for (std::size_t axis = 0; axis < dimensions(K); ++axis) cell *= mean_cell(problem.grid, axis);
  cell = std::pow(cell, 1.0 / dimensions(K));
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
  if (problem.geostatic) set_geostatic_stress(problem, body, origin);
  if (!problem.initial_stress.empty()) set_uniform_stress(problem, body, origin);
  check_initial_stress(problem, body);
  set_strength_by_place(problem, body, origin);
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
