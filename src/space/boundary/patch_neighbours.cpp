#include "space/boundary/patch_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stillpoint {

// Weights fall from 1 to 0 within two cells along each axis.
template <Kinematics K>
void PatchNeighbours::find(std::span<const SurfacePatch> patches, const std::vector<BorderPiece<K>>& pieces,
                           const std::vector<std::size_t>& groups) {
  constexpr int dim = dimensions(K);
  constexpr double smooth = 0.7;  // the cosine between normals: beyond a corner the border is another one
  struct Place {
    Point<dim> x{}, n{};
    double area = 0, cell = 0;
    std::size_t body = 0;
  };
  group_ = groups;
  std::vector<Place> places(patches.empty() ? 0 : group_of(patches.size() - 1) + 1);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    Place& place = places[group_of(k)];
    place.body = patches[k].body;
    place.cell = std::max(place.cell, patches[k].cell);
    for (std::size_t s = patches[k].begin; s < patches[k].end; ++s) {
      const Point<dim> x = pieces[s].place();
      const double size = pieces[s].size();
      place.area += size;
      for (std::size_t d = 0; d < dim; ++d) place.x[d] += size * x[d], place.n[d] += pieces[s].vector[d];
    }
  }
  for (Place& place : places) {
    double square = 0;
    for (std::size_t d = 0; d < dim; ++d) place.x[d] /= place.area, square += place.n[d] * place.n[d];
    for (std::size_t d = 0; d < dim; ++d) place.n[d] /= std::sqrt(square);
  }
  std::vector<std::size_t> order(places.size());  // along the first axis
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return places[k].x[0]; });
  double widest = 0;
  for (const Place& place : places) widest = std::max(widest, place.cell);

  std::vector<std::vector<Neighbour>> of(places.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t k = order[i];
    for (std::size_t j = i + 1; j < order.size() && places[order[j]].x[0] - places[k].x[0] < 2 * widest; ++j) {
      const std::size_t l = order[j];
      if (places[l].body != places[k].body) continue;
      const double reach = 2 * std::max(places[k].cell, places[l].cell);
      double weight = 1, cosine = 0;
      for (std::size_t d = 0; d < dim; ++d) {
        weight *= std::max(0.0, 1 - std::abs(places[l].x[d] - places[k].x[d]) / reach);
        cosine += places[k].n[d] * places[l].n[d];
      }
      if (!(weight > 0 && cosine > smooth)) continue;
      of[k].push_back({l, weight});
      of[l].push_back({k, weight});
    }
  }
  begin_.assign(1, 0);
  list_.clear();
  for (const std::vector<Neighbour>& one : of) {
    list_.insert(list_.end(), one.begin(), one.end());
    begin_.push_back(list_.size());
  }
}

template void PatchNeighbours::find(std::span<const SurfacePatch>, const std::vector<BorderPiece<Kinematics::line>>&,
                                    const std::vector<std::size_t>&);
template void PatchNeighbours::find(std::span<const SurfacePatch>, const std::vector<BorderPiece<Kinematics::plane>>&,
                                    const std::vector<std::size_t>&);
template void PatchNeighbours::find(std::span<const SurfacePatch>,
                                    const std::vector<BorderPiece<Kinematics::axisymmetric>>&,
                                    const std::vector<std::size_t>&);
template void PatchNeighbours::find(std::span<const SurfacePatch>, const std::vector<BorderPiece<Kinematics::space>>&,
                                    const std::vector<std::size_t>&);

}  // namespace stillpoint
