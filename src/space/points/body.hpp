// The body of a scene: its material points and their materials.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/grid_lines.hpp"
#include "space/materials/material_laws.hpp"
#include "space/materials/point_material.hpp"
#include "space/points/material_points.hpp"
#include "space/points/motion_fields.hpp"

namespace stillpoint {

template <Kinematics K>
struct Body {
  static constexpr int dim = dimensions(K);
  MaterialPoints<dim> points;
  QuadratureReport quadrature;
  std::vector<std::unique_ptr<PointMaterial<K>>> materials;  // in order of points.material_begin
  std::vector<std::string> material_names;                   // likewise; one in two fields is there twice
  std::vector<double> smallest_density;                      // of each material, before the motion [kg/m³]
  int fields = 1;                                            // see motion_fields.hpp
  std::vector<CellShares> covered;  // cells covered by each [[body]]; empty if that of one is not known
  std::vector<int> first_number;    // number of the first point of each [[body]], and the number of all points: (bodies
                                    // + 1)

  std::vector<char> carried_on;  // whether a stage or another run has left the points of each [[body]]

  /// The number of points that the body was filled with; domains that are halved have the number of their whole.
  std::size_t numbers() const { return static_cast<std::size_t>(first_number.back()); }
};

namespace detail {

/// With a static solver, in which no time passes, no material is viscous.
template <Kinematics K>
std::unique_ptr<PointMaterial<K>> make_material(const MaterialSpec& material, const Problem& problem, std::size_t begin,
                                                std::size_t count, bool updated_lagrangian) {
  const MaterialSpec of_grid = with_bands_of(material, mean_cell(problem.grid));
  return make_point_material<K>(problem.solve.is_static() ? rate_independent(of_grid) : of_grid, problem.state, begin,
                                count, updated_lagrangian);
}

}  // namespace detail

/// Gives each material other parameters of the same law; its points keep their stored states.
template <Kinematics K>
void change_materials(Body<K>& body, const std::map<std::string, MaterialSpec>& materials, const Problem& problem,
                      bool updated_lagrangian) {
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const MaterialSpec& spec = materials.at(body.material_names[m]);
    const auto begin = static_cast<std::size_t>(body.points.material_begin[m]);
    const std::size_t count = static_cast<std::size_t>(body.points.material_begin[m + 1]) - begin;
    auto changed = detail::make_material<K>(spec, problem, begin, count, updated_lagrangian);
    const Vec before = body.materials[m]->memory(), now = changed->memory();
    if (before.size() != now.size())
      throw std::invalid_argument("a material cannot be changed into one of another law");
    std::ranges::copy(before, now.begin());
    body.materials[m] = std::move(changed);
  }
}

/// Transfers the stored states of the materials to a changed set of points: point p is a copy of the former from[p].
template <Kinematics K>
void take_materials(Body<K>& body, const std::vector<int>& from) {
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    const auto begin = static_cast<std::size_t>(body.points.material_begin[m]);
    body.materials[m]->take(from, begin, static_cast<std::size_t>(body.points.material_begin[m + 1]) - begin);
  }
}

}  // namespace stillpoint
