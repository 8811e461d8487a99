#include "simulation/later_ground.hpp"

#include <map>
#include <string>

#include "plan/catalogue.hpp"
#include "scene/dimensions.hpp"
#include "scene/resolve.hpp"
#include "scene/stages.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/points/material_points.hpp"
#include "space/points/value_by_place.hpp"

namespace stillpoint {
namespace {

// The points are those that the stage will place: of a body that changes, where it was placed.
template <int Dim>
void check_ground(const Problem& problem, const BodySpec& body, const MaterialSpec& material) {
  const MaterialPoints<Dim> points = place_body<Dim>(body, grid_at<Dim>(problem, 0), material.parameters.at("rho"),
                                                     problem.state, problem.phase.quadrature == Quadrature::domains)
                                         .points;
  for (const auto& [parameter, formula] : material.by_place)
    for (std::size_t p = 0; p < points.size(); ++p) (void)value_by_place(material, parameter, points.position(p));
}

}  // namespace

void check_ground_of_later_stages(Scene scene) {
  std::map<std::size_t, std::string> material_of;
  for (const BodySpec& body : scene.bodies) material_of[body.number] = body.material;
  while (!scene.stages.empty()) {
    begin_next_stage(scene);
    resolve(scene, catalogue());
    for (const BodySpec& body : scene.bodies) {
      const MaterialSpec& material = scene.materials.at(body.material);
      std::string& before = material_of[body.number];
      if (before == body.material || material.by_place.empty()) continue;
      before = body.material;
      try {
        with_dimension(scene.dim, [&]<int Dim>() { check_ground<Dim>(scene, body, material); });
      } catch (const SceneError& error) {
        throw scene.located(error);
      }
    }
  }
}

}  // namespace stillpoint
