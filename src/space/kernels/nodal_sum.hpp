// Sums over material points at the grid's functions, as Σ_p m_p N_ip, the same bits for any number of threads and
// ranks.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <vector>

#include "base/parallel_loop.hpp"
#include "space/kernels/corner_sum.hpp"
#include "space/kernels/point_weights.hpp"

namespace stillpoint {

/// Values of one cell at its corners: component c of local function a at [Components a + c].
template <int Components, int PerCell>
using Corners = std::array<double, static_cast<std::size_t>(Components* PerCell)>;

/// The sums at the functions, (functions × Components). add_cell(k, corners) adds the contributions of the points of
/// cell k. of_corners: work space, which grows to what is needed once.
template <int Components, AxisBasis B, Kinematics K, class AddCell>
std::vector<double> nodal_sum(const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>&,
                              const CornerSum& corner_sum, const AddCell& add_cell, std::vector<double>& of_corners) {
  constexpr int per_cell = PointWeights<B, K>::per_cell;
  of_corners.resize(std::max(of_corners.size(), Components * corner_sum.corners() + CornerSum::slack));
  for_each_block(points.cells(), [&](std::size_t k) {
    Corners<Components, per_cell> corners{};
    add_cell(k, corners);
    std::copy(corners.begin(), corners.end(), of_corners.begin() + static_cast<std::ptrdiff_t>(corners.size() * k));
  });
  std::vector<double> sums(Components * corner_sum.functions());
  corner_sum.sum_at_functions<Components>(of_corners.data(), sums.data());
  return sums;
}
template <int Components, AxisBasis B, Kinematics K, class AddCell>
std::vector<double> nodal_sum(const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>& weights,
                              const CornerSum& corner_sum, const AddCell& add_cell) {
  std::vector<double> of_corners;
  return nodal_sum<Components>(points, weights, corner_sum, add_cell, of_corners);
}

/// G_i = Σ_p V_p A_p |∇N_ip| Σ_j |∇N_jp| with the wave modulus A_p = λ + 2μ, (functions) [N/m]: a bound of Σ_j |K_ij|
/// in the norm of 2 × 2 blocks, since |B_iᵀ C B_j| ≤ (λ + 2μ) |∇N_i| |∇N_j|. By Gershgorin no frequency of a lumped M
/// exceeds max √(G_i/M_i). The sum is over the occupied cells k for which counts(k) holds.
template <AxisBasis B, Kinematics K, class Counts>
requires(std::predicate<Counts, std::size_t>) std::vector<double> stiffness_bound(
    const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>& weights, const CornerSum& corner_sum,
    const std::vector<double>& wave_modulus, const Counts& counts) {
  constexpr int per_cell = PointWeights<B, K>::per_cell, rows = PointWeights<B, K>::rows;
  return nodal_sum<1>(points, weights, corner_sum, [&](std::size_t k, Corners<1, per_cell>& corner) {
    if (!counts(k)) return;
    const double A = wave_modulus[static_cast<std::size_t>(points.material_of_cell(k))];
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      const auto dN = weights.dN(k, p);
      std::array<double, per_cell> length;
      double together = 0;
      for (int a = 0; a < per_cell; ++a) {
        double square = 0;
        for (int j = 0; j < rows; ++j) square += dN[per_cell * j + a] * dN[per_cell * j + a];
        length[a] = std::sqrt(square);
        together += length[a];
      }
      for (int a = 0; a < per_cell; ++a) corner[a] += points.volume[p] * A * length[a] * together;
    }
  });
}

}  // namespace stillpoint
