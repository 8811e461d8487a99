#include "space/kernels/nodal_inertia.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel_loop.hpp"

namespace stillpoint {

template <int Dim>
void NodalInertia<Dim>::begin_phase(std::vector<double> mass, const std::vector<double>& G,
                                    const std::vector<char>& is_free) {
  mass_ = std::move(mass);
  inertia_ = mass_;
  added_.clear();
  const bool gershgorin = spec_.scaling == MassScaling::gershgorin;
  const double all_mass = sum_over(mass_.size(), [&](std::size_t f) { return mass_[f]; });
  if (!(omega_squared_ > 0)) {
    omega_squared_ = sum_over(G.size(), [&](std::size_t f) { return G[f]; }) / all_mass;
  }
  if (gershgorin) {
    std::ranges::transform(G, inertia_.begin(), [&](double bound) { return bound / omega_squared_; });
  } else {
    find_light(G, is_free);
  }
  double added = 0;
  for (std::size_t f = 0; gershgorin && f < mass_.size(); ++f) added += std::max(0.0, inertia_[f] - mass_[f]);
  for (const AddedInertia& one : added_) added += one.inertia;
  largest_added_share_ = std::max(largest_added_share_, added / all_mass);
  for (double& inertia : inertia_) inertia *= spec_.factor;
  for (AddedInertia& one : added_) one.inertia *= spec_.factor;
}

// Finds light nodes; in a single phase only those with next to no mass: points on a grid line reach the nodes across
// a cell by their gradients alone.
template <int Dim>
void NodalInertia<Dim>::find_light(const std::vector<double>& G, const std::vector<char>& is_free) {
  constexpr double most = 1.2;       // a tenth above the highest frequency: within the margin of the step
  constexpr double massless = 1e-9;  // share of G/Ω²
  std::vector<double> share(mass_.size());
  for (std::size_t f = 0; f < mass_.size(); ++f) {
    const double needed = G[f] / (most * omega_squared_);
    const double enough = updated_lagrangian_ ? needed : massless * needed;
    if (is_free[f] && needed > 0) share[f] = mass_[f] / enough;
    if (mass_[f] < enough) added_.push_back({.function = static_cast<int>(f), .inertia = needed - mass_[f]});
  }
  if (!functions_.partition_of_unity()) return;
  const Extrapolator<Dim> extrapolate(functions_, share);
  for (AddedInertia& one : added_) {
    if (!is_free[static_cast<std::size_t>(one.function)]) continue;
    one.relative_to = extrapolate(one.function).value_or(Extrapolation{});
  }
  // Without neighbours, as at a single point, the function nearest to the point moves with it.
  constexpr double most_of_it = 0.5;
  std::erase_if(added_, [&](const AddedInertia& one) {
    return one.relative_to.functions == 0 && share[static_cast<std::size_t>(one.function)] > most_of_it;
  });
  // A function with less is extrapolated from the point's next best function, and that from it: the point still
  // falls freely.
  for (AddedInertia& one : added_) {
    if (one.relative_to.functions > 0 || !is_free[static_cast<std::size_t>(one.function)]) continue;
    one.relative_to = extrapolate.from_next_best(one.function).value_or(Extrapolation{});
  }
}

template class NodalInertia<1>;
template class NodalInertia<2>;
template class NodalInertia<3>;

}  // namespace stillpoint
