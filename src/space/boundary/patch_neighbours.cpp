#include "space/boundary/patch_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stillpoint {

// Weights fall from 1 to 0 within two cells along each axis.
template <Kinematics K>
void PatchNeighbours::find(std::span<const SurfacePatch> patches, const std::vector<BorderPiece<K>>& pieces) {
  constexpr int dim = dimensions(K);
  constexpr double smooth = 0.7;  // the cosine between normals: beyond a corner the border is another one
  struct Place {
    Point<dim> x{}, n{};
  };
  std::vector<Place> places(patches.size());
  for (std::size_t k = 0; k < patches.size(); ++k) {
    double area = 0, square = 0;
    for (std::size_t s = patches[k].begin; s < patches[k].end; ++s) {
      const Point<dim> x = pieces[s].place();
      const double size = pieces[s].size();
      area += size;
      for (std::size_t d = 0; d < dim; ++d) places[k].x[d] += size * x[d], places[k].n[d] += pieces[s].vector[d];
    }
    for (std::size_t d = 0; d < dim; ++d) places[k].x[d] /= area, square += places[k].n[d] * places[k].n[d];
    for (std::size_t d = 0; d < dim; ++d) places[k].n[d] /= std::sqrt(square);
  }
  std::vector<std::size_t> order(patches.size());  // along the first axis
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return places[k].x[0]; });
  double widest = 0;
  for (const SurfacePatch& patch : patches) widest = std::max(widest, patch.cell);

  std::vector<std::vector<Neighbour>> of(patches.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t k = order[i];
    for (std::size_t j = i + 1; j < order.size() && places[order[j]].x[0] - places[k].x[0] < 2 * widest; ++j) {
      const std::size_t l = order[j];
      if (patches[l].body != patches[k].body) continue;
      const double reach = 2 * std::max(patches[k].cell, patches[l].cell);
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

template void PatchNeighbours::find(std::span<const SurfacePatch>, const std::vector<BorderPiece<Kinematics::line>>&);
template void PatchNeighbours::find(std::span<const SurfacePatch>, const std::vector<BorderPiece<Kinematics::plane>>&);
template void PatchNeighbours::find(std::span<const SurfacePatch>,
                                    const std::vector<BorderPiece<Kinematics::axisymmetric>>&);
template void PatchNeighbours::find(std::span<const SurfacePatch>, const std::vector<BorderPiece<Kinematics::space>>&);

}  // namespace stillpoint
