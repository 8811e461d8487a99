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

template <Kinematics K>
void set_geostatic_stress(const Problem& problem, Body<K>& body) {
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
      body.materials[m]->set_stress(stress);
    }
  }
}

template <Kinematics K>
void set_parameters_by_place(const Problem& problem, Body<K>& body) {
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const auto begin = static_cast<std::size_t>(body.points.material_begin[m]);
    const Vec shares = body.materials[m]->strength_shares();
    for (const auto& [name, formula] : problem.materials.at(body.material_names[m]).by_place) {
      for (std::size_t k = 0; k < shares.size(); ++k) {
        const auto x = body.points.position(begin + k);
        shares[k] = formula(x, 0);
        if (!(shares[k] >= 0) || !std::isfinite(shares[k]))
          throw_scene_error(fmt::format("material.{}.{}", body.material_names[m], name),
                            fmt::format("must be >= 0 everywhere, not {} at ({:.6g})", shares[k], fmt::join(x, ", ")));
      }
    }
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
void set_initial_state(const Problem& problem, Body<K>& body) {
  if (problem.geostatic) set_geostatic_stress(problem, body);
  set_parameters_by_place(problem, body);
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

template void set_initial_state(const Problem&, Body<Kinematics::line>&);
template void set_initial_state(const Problem&, Body<Kinematics::plane>&);
template void set_initial_state(const Problem&, Body<Kinematics::axisymmetric>&);
template void set_initial_state(const Problem&, Body<Kinematics::space>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::line>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::plane>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::axisymmetric>&);
template void set_initial_velocity(const Problem&, Body<Kinematics::space>&);

}  // namespace stillpoint
