// Mass and stiffness bound of the functions N_k + Σ_e W_ek N_e that extended functions follow, see ExtendedFunctions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "space/grid/extended_functions.hpp"
#include "space/kernels/nodal_sum.hpp"

namespace stillpoint {

/// Sets the mass of these functions, m_k + Σ_e W_ek m_e with m of NodalTotals, and 0 for the extended ones. Where the
/// basis is no partition of unity m_e is shared in proportion to W_ek², so that value functions keep it.
template <AxisBasis B, int Dim>
void give_mass_to_sources(const Grid<Dim>& grid, const ExtendedFunctions& extension, std::vector<double>& mass) {
  const auto is_value = [&](int function) { return TensorBasis<B, Dim>::is_value(grid, function); };
  for (const int function : extension.functions()) {
    const double given = std::exchange(mass[static_cast<std::size_t>(function)], 0);
    const auto sources = extension.sources_of(function);
    double of_values = 0;
    for (const auto& [source, weight] : sources) of_values += is_value(source) ? weight * weight : 0;
    for (const auto& [source, weight] : sources) {
      double share = weight;
      // A slope's mass does not count towards the body's mass.
      if constexpr (!B::partition_of_unity) share = is_value(function) ? weight * weight / of_values : 0;
      mass[static_cast<std::size_t>(source)] += given * share;
    }
  }
}

/// The stiffness_bound() of these functions; 0 for the extended ones.
template <AxisBasis B, Kinematics K>
std::vector<double> stiffness_bound(const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>& weights,
                                    const CornerSum& corner_sum, const std::vector<double>& wave_modulus,
                                    const ExtendedFunctions& extension) {
  constexpr int per_cell = PointWeights<B, K>::per_cell, rows = PointWeights<B, K>::rows;
  std::vector<char> has_extended(points.cells(), 0);
  for (std::size_t k = 0; k < points.cells() && !extension.empty(); ++k) {
    for (int a = 0; a < per_cell && !has_extended[k]; ++a) has_extended[k] = extension.contains(weights.function(k, a));
  }
  std::vector<double> G =
      stiffness_bound(points, weights, corner_sum, wave_modulus, [&](std::size_t k) { return !has_extended[k]; });
  struct Share {
    CellPlace of;
    int function;
    double bound;
  };
  std::vector<Share> shares;
  for (std::size_t k = 0; k < points.cells(); ++k) {
    if (!has_extended[k]) continue;
    const double A = wave_modulus[static_cast<std::size_t>(points.material_of_cell(k))];
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      const auto dN = weights.dN(k, p);
      std::map<int, std::array<double, rows>> gradients;  // gradients of the functions that are not extended
      const auto add = [&](int function, double weight, int a) {
        auto& gradient = gradients.try_emplace(function).first->second;
        for (int j = 0; j < rows; ++j) gradient[static_cast<std::size_t>(j)] += weight * dN[per_cell * j + a];
      };
      for (int a = 0; a < per_cell; ++a) {
        const int function = weights.function(k, a);
        if (!extension.contains(function)) {
          add(function, 1, a);
        } else {
          for (const auto& source : extension.sources_of(function)) add(source.function, source.weight, a);
        }
      }
      const auto length = [](const std::array<double, rows>& gradient) {
        double square = 0;
        for (const double along : gradient) square += along * along;
        return std::sqrt(square);
      };
      double together = 0;
      for (const auto& [function, gradient] : gradients) together += length(gradient);
      for (const auto& [function, gradient] : gradients)
        shares.push_back({place_of_cell(points, k), function, points.volume[p] * A * length(gradient) * together});
    }
  }
  shares = joined_lists(corner_sum.ranks(), std::move(shares));
  std::ranges::stable_sort(shares, {}, &Share::of);
  for (const Share& share : shares) G[static_cast<std::size_t>(share.function)] += share.bound;
  return G;
}

}  // namespace stillpoint
