// A scene of plane strain as one in space.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace scenes {

/// A slab as wide as one cell, of thickness 1, between two rollers across z, with so many material points across it:
/// what it does is what the plane scene does. Loads on lines have to be on the top face.
inline stillpoint::Scene slab(stillpoint::Scene plane, int points_across = 1) {
  using namespace stillpoint;
  if (plane.state != StressState::plane_strain)
    throw std::invalid_argument("a slab between rollers is in plane strain");
  Scene scene = std::move(plane);
  const auto add_z = [](std::vector<double>& position, double z) {
    if (!position.empty()) position.push_back(z);
  };
  const auto add_component = [](std::vector<Expression>& components) {
    if (!components.empty()) components.emplace_back(0.0);
  };
  scene.dim = 3;
  scene.state = StressState::space;
  scene.grid.min.push_back(0);
  scene.grid.max.push_back(1);
  scene.grid.cells.push_back(1);
  for (BodySpec& body : scene.bodies) {
    body.state = StressState::space;
    std::vector<double> low = body.min, high = body.max;
    low.push_back(0);
    high.push_back(1);
    body.min = low;
    body.max = high;
    body.points_per_cell.push_back(points_across);
  }
  for (TractionSpec& traction : scene.tractions) {
    add_component(traction.value);
    if (traction.line.empty()) continue;
    traction.face = Face::top;
    traction.from = {traction.line[0][0], 0};
    traction.to = {traction.line[1][0], 1};
    traction.line.clear();
  }
  add_component(scene.body_force);
  add_component(scene.initial_u);
  add_component(scene.initial_v);
  scene.exact = {};
  for (ProbeSpec& probe : scene.probes) {
    add_z(probe.at, 0.5);
    if (probe.kind != ProbeKind::slope_angle) continue;
    probe.min = scene.grid.min;  // of all points, wherever the grid follows a wall to
    for (const double upper : scene.grid.max) probe.max.push_back(10 * upper);
  }
  for (const Face face : {Face::back, Face::front})
    scene.supports.push_back({.face = face, .roller = true, .component = axis_of(face)});
  return scene;
}

}  // namespace scenes
