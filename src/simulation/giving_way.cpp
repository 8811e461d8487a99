#include "simulation/giving_way.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel_loop.hpp"

namespace stillpoint {

GivingWay::GivingWay(const Problem& problem, const LagrangianPhase& phase) : phase_(phase) {
  remembers_ = phase.history_dependent();
  yields_ = std::ranges::count(phase.info().history_names, plastic_strain_name) > 0;
  for (const WallSpec& wall : problem.walls) friction_.push_back(wall.friction);
  has_friction_ = std::ranges::any_of(friction_, [](double mu) { return mu > 0 && std::isfinite(mu); });
  if (yields_) volumes_ = phase.fields().point_data().volumes;
}

double GivingWay::plastic_strain() const {
  if (!yields_) return 0;
  std::vector<double> of_points(volumes_.size());  // not kept: memory counts more than the time of a sample
  phase_.fields().point_history(plastic_strain_name, of_points);
  return sum_over(volumes_.size(), [&](std::size_t p) { return volumes_[p] * of_points[p]; });
}

std::vector<std::size_t> GivingWay::sliding_walls(double t) const {
  constexpr double sliding_share = 0.95;  // of the largest |T|, as a node here and there may stick for a moment
  std::vector<std::size_t> sliding;
  if (!has_friction_) return sliding;
  const std::vector<WallReaction> walls = phase_.supports().wall_reactions(t);
  for (std::size_t k = 0; k < std::min(walls.size(), friction_.size()); ++k) {
    const double T = std::hypot(walls[k].shear[0], walls[k].shear[1]), N = std::abs(walls[k].normal);
    if (friction_[k] > 0 && std::isfinite(friction_[k]) && N > 0 && T >= sliding_share * friction_[k] * N)
      sliding.push_back(k);
  }
  return sliding;
}

}  // namespace stillpoint
