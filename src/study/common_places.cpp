#include "study/common_places.hpp"

#include "scene/dimensions.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {
namespace {

constexpr int along_axis = 2;

template <int Dim>
CommonPlaces places_on(const Problem& problem) {
  CommonPlaces places;
  const Grid<Dim> grid = grid_at<Dim>(problem, 0);
  for (BodySpec body : problem.bodies) {
    body.placement = Placement::gauss;
    body.points_per_cell.assign(Dim, along_axis);
    body.jitter = 0;
    const double density = problem.materials.at(body.material).parameters.at("rho");
    const MaterialPoints<Dim> points = place_body<Dim>(body, grid, density, problem.state).points;
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (int d = 0; d < Dim; ++d) places.x.push_back(points.x[d][p]);
      places.volume.push_back(points.volume[p]);
    }
  }
  return places;
}

}  // namespace

CommonPlaces common_places(const Problem& problem) {
  return with_dimension(problem.dim, [&]<int Dim>() { return places_on<Dim>(problem); });
}

double count_of_places(const Problem& problem) {
  double count = 1;
  for (const int cells : problem.grid.cells) count *= along_axis * static_cast<double>(cells);
  return count;
}

FieldsAtPlaces read_at(const CommonPlaces& places, const PlaceReader& reader, std::size_t stress_components) {
  const std::size_t dim = places.x.size() / places.size();
  FieldsAtPlaces fields{std::vector<double>(places.x.size()), std::vector<double>(places.size() * stress_components)};
  for (std::size_t p = 0; p < places.size(); ++p) {
    const ConstVec x(places.x.data() + dim * p, dim);
    reader.displacement(x, Vec(fields.u.data() + dim * p, dim));
    reader.stress(x, Vec(fields.stress.data() + stress_components * p, stress_components));
  }
  return fields;
}

}  // namespace stillpoint
