// The body of a scene: its material points and their materials.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "space/materials/material_laws.hpp"
#include "space/materials/point_material.hpp"
#include "space/points/material_points.hpp"
#include "space/points/motion_fields.hpp"
#include "space/points/point_order.hpp"

namespace stillpoint {

template <Kinematics K>
struct Body {
  static constexpr int dim = dimensions(K);
  MaterialPoints<dim> points;
  QuadratureReport quadrature;
  std::vector<std::unique_ptr<PointMaterial<K>>> materials;  // in order of points.material_begin
  std::vector<std::string> material_names;                   // likewise; one in two fields is there twice
  int fields = 1;                                            // see motion_fields.hpp
  std::vector<CellShares> covered;  // cells covered by each [[body]]; empty if that of one is not known
  std::vector<int> first_number;    // number of the first point of each [[body]], and the number of all points: (bodies
                                    // + 1)

  /// The number of points that the body was filled with; domains that are halved have the number of their whole.
  std::size_t numbers() const { return static_cast<std::size_t>(first_number.back()); }
};

namespace detail {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// With a static solver, in which no time passes, no material is viscous.
template <Kinematics K>
std::unique_ptr<PointMaterial<K>> make_material(const MaterialSpec& material, const Problem& problem, std::size_t begin,
                                                std::size_t count, bool updated_lagrangian) {
  return make_point_material<K>(problem.solve.is_static() ? rate_independent(material) : material, problem.state, begin,
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

/// Places every body of the scene. Points are numbered body by body, in the order in which a body is filled.
/// updated_lagrangian: whether points will change cells. With a static solver, in which no time passes, no material is
/// viscous.
template <Kinematics K>
Body<K> make_body(const Problem& problem, const Grid<dimensions(K)>& grid, bool updated_lagrangian) {
  constexpr int dim = dimensions(K);
  Body<K> body;
  MaterialPoints<dim>& points = body.points;
  std::vector<MaterialPoints<dim>> of_bodies;
  int number = 0;
  for (const BodySpec& spec : problem.bodies) {
    PlacedBody<dim> placed = place_body<dim>(spec, grid, problem.materials.at(spec.material).parameters.at("rho"),
                                             problem.state, problem.phase.quadrature == Quadrature::domains);
    body.quadrature.add(placed.quadrature);
    if (!placed.covered.empty()) body.covered.push_back(std::move(placed.covered));
    body.first_number.push_back(number);
    number += static_cast<int>(placed.points.size());
    of_bodies.push_back(std::move(placed.points));
  }
  body.first_number.push_back(number);
  const MotionFields fields = motion_fields<dim>(problem, grid, of_bodies);
  body.fields = fields.count;
  std::map<std::pair<std::string, int>, std::vector<std::size_t>> by_material;  // the bodies of a material in a field
  for (std::size_t k = 0; k < of_bodies.size(); ++k)
    by_material[{problem.bodies[k].material, fields.of_body[k]}].push_back(k);
  if (fields.count > 1) points.field_of_body = fields.of_body;
  for (const auto& [material_in_field, bodies] : by_material) {
    const auto& [name, field] = material_in_field;
    points.material_begin.push_back(static_cast<int>(points.size()));
    if (fields.count > 1) points.field_of_material.push_back(field);
    for (const std::size_t k : bodies) {
      const MaterialPoints<dim>& part = of_bodies[k];
      const int first_number = body.first_number[k];
      for (int d = 0; d < dim; ++d) detail::append(points.x[d], part.x[d]);
      detail::append(points.volume, part.volume);
      detail::append(points.mass, part.mass);
      for (std::size_t c = 0; c < points.corner.size(); ++c) detail::append(points.corner[c], part.corner[c]);
      for (int d = 0; d < dim; ++d) {
        detail::append(points.half[d], part.half[d]);
        detail::append(points.rest[d], part.rest[d]);
      }
      for (std::size_t p = 0; p < part.size(); ++p) points.number.push_back(first_number + static_cast<int>(p));
    }
    const auto begin = static_cast<std::size_t>(points.material_begin.back());
    body.materials.push_back(detail::make_material<K>(problem.materials.at(name), problem, begin, points.size() - begin,
                                                      updated_lagrangian));
    body.material_names.push_back(name);
  }
  points.material_begin.push_back(static_cast<int>(points.size()));
  if (body.covered.size() < problem.bodies.size()) body.covered.clear();
  if (updated_lagrangian) {
    for (auto& v : points.v) v.assign(points.size(), 0);
    if (problem.phase.transfer == Transfer::apic) {
      for (auto& B : points.B_apic) B.assign(points.size(), 0);
    }
  }
  PointOrder<dim>().sort(points, grid);
  return body;
}

}  // namespace stillpoint
