// The bodies of a scene, placed or as a stage has left them.
#pragma once

#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "space/points/body.hpp"
#include "space/points/carried_body.hpp"
#include "space/points/motion_fields.hpp"
#include "space/points/point_order.hpp"
#include "space/points/states_of_stage.hpp"
#include "space/points/value_by_place.hpp"

namespace stillpoint {
namespace detail {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Appends the velocities of points that change cells; those of points that were placed are 0.
template <int Dim>
void append_motion(const MaterialPoints<Dim>& part, bool moves_on, bool apic, MaterialPoints<Dim>& points) {
  if (!moves_on) return;
  const std::vector<double> rest(part.size(), 0);
  for (int d = 0; d < Dim; ++d) append(points.v[d], part.v[d].empty() ? rest : part.v[d]);
  for (std::size_t ij = 0; apic && ij < part.B_apic.size(); ++ij)
    append(points.B_apic[ij], part.B_apic[ij].empty() ? rest : part.B_apic[ij]);
}

}  // namespace detail

/// Places every body of the scene, or takes its points as a stage has left them. Points are numbered body by body, in
/// the order in which a body is filled. updated_lagrangian: whether points will change cells. carried: null at the
/// start of a run. With a static solver, in which no time passes, no material is viscous.
template <Kinematics K>
Body<K> make_body(const Problem& problem, const Grid<dimensions(K)>& grid, bool updated_lagrangian,
                  const CarriedBodyOf<K>* carried = nullptr) {
  constexpr int dim = dimensions(K);
  Body<K> body;
  MaterialPoints<dim>& points = body.points;
  std::vector<MaterialPoints<dim>> of_bodies;
  std::vector<std::vector<int>> sources;  // of the points of each body among those that are carried on
  int number = 0;
  for (const BodySpec& spec : problem.bodies) {
    const MaterialSpec& material = problem.materials.at(spec.material);
    sources.emplace_back();
    body.first_number.push_back(number);
    const auto before = carried ? carried->find(spec) : std::nullopt;
    body.carried_on.push_back(before.has_value());
    if (before) {
      number += static_cast<int>(carried->numbers_of(*before));
      of_bodies.push_back(carried->points_of(*before, material, sources.back()));
      continue;
    }
    PlacedBody<dim> placed = place_body<dim>(spec, grid, material.parameters.at("rho"), problem.state,
                                             problem.phase.quadrature == Quadrature::domains);
    body.quadrature.add(placed.quadrature);
    if (!placed.covered.empty()) body.covered.push_back(std::move(placed.covered));
    placed.points.number.resize(placed.points.size());
    std::iota(placed.points.number.begin(), placed.points.number.end(), 0);
    if (carried) sources.back().assign(placed.points.size(), -1);
    number += static_cast<int>(placed.points.size());
    if (material.by_place.contains("rho")) {
      for (std::size_t p = 0; p < placed.points.size(); ++p)
        placed.points.mass[p] = placed.points.volume[p] * value_by_place(material, "rho", placed.points.position(p));
    }
    of_bodies.push_back(std::move(placed.points));
  }
  body.first_number.push_back(number);
  const MotionFields fields = motion_fields<dim>(problem, grid, of_bodies);
  body.fields = fields.count;
  std::map<std::pair<std::string, int>, std::vector<std::size_t>> by_material;  // the bodies of a material in a field
  for (std::size_t k = 0; k < of_bodies.size(); ++k)
    by_material[{problem.bodies[k].material, fields.of_body[k]}].push_back(k);
  if (fields.count > 1) points.field_of_body = fields.of_body;
  std::vector<int> source;
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
      for (const int in_body : part.number) points.number.push_back(first_number + in_body);
      detail::append_motion(part, updated_lagrangian, problem.phase.transfer == Transfer::apic, points);
      detail::append(source, sources[k]);
    }
    const auto begin = static_cast<std::size_t>(points.material_begin.back());
    body.materials.push_back(detail::make_material<K>(problem.materials.at(name), problem, begin, points.size() - begin,
                                                      updated_lagrangian));
    body.material_names.push_back(name);
  }
  points.material_begin.push_back(static_cast<int>(points.size()));
  if (body.covered.size() < problem.bodies.size()) body.covered.clear();
  PointOrder<dim> order;
  order.sort(points, grid);
  if (carried) {
    std::vector<int> work;
    order.order().apply(source, work);
    take_states(problem, *carried, source, body);
  }
  return body;
}

}  // namespace stillpoint
