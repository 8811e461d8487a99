// The inertia of the grid's functions: their mass, scaled if the scene says so.
//
// In a body that moves on, points come to lie next to a cell's edge and give nodes across it stiffness but hardly any
// mass: their frequencies would shorten the step without end, or blow the run up. Such a node gets as much inertia as
// its stiffness bound G_i needs to keep below the frequency bound of the body as a whole when the run began,
//
//   M_i = max(m_i, G_i/Ω²),   Ω² = Σ G_i/Σ m_i,
//
// while its weight and its momentum stay those of its mass m_i. Scaled by Gershgorin, every node has the same bound:
// M_i = G_i/Ω², whose sum is the body's mass.
#pragma once

#include <algorithm>
#include <vector>

#include "space/kernels/nodal_sum.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class NodalInertia {
 public:
  NodalInertia(const MassSpec& spec, bool updated_lagrangian) : spec_(spec), updated_lagrangian_(updated_lagrangian) {}

  /// wave_modulus: λ + 2μ of each material [Pa].
  void begin_phase(const MaterialPoints<dimensions(K)>& points, const PointWeights<B, K>& weights,
                   const CornerSum& corner_sum, const std::vector<double>& wave_modulus) {
    mass_ = nodal_mass(points, weights, corner_sum);
    inertia_ = mass_;
    const bool gershgorin = spec_.scaling == MassScaling::gershgorin;
    if (updated_lagrangian_ || gershgorin) {
      const std::vector<double> G = stiffness_bound(points, weights, corner_sum, wave_modulus);
      const double all_mass = sum_over(mass_.size(), [&](std::size_t f) { return mass_[f]; });
      if (!(omega_squared_ > 0)) {
        omega_squared_ = sum_over(G.size(), [&](std::size_t f) { return G[f]; }) / all_mass;
      }
      double added = 0;
      for (std::size_t f = 0; f < inertia_.size(); ++f) {
        const double needed = G[f] / omega_squared_;
        added += std::max(0.0, needed - mass_[f]);
        inertia_[f] = gershgorin ? needed : std::max(mass_[f], needed);
      }
      largest_added_share_ = std::max(largest_added_share_, added / all_mass);
    }
    for (double& inertia : inertia_) inertia *= spec_.factor;
  }

  const std::vector<double>& mass() const { return mass_; }        // m_i, (functions) [kg]
  const std::vector<double>& inertia() const { return inertia_; }  // M_i, (functions) [kg]
  /// What nodes were given beyond their mass, uniform scaling apart, as a share of the body's mass; the most so far.
  double largest_added_mass() const { return largest_added_share_; }

 private:
  MassSpec spec_;
  bool updated_lagrangian_;
  std::vector<double> mass_, inertia_;
  double omega_squared_ = 0;  // Ω², kept from the first phase [1/s²]
  double largest_added_share_ = 0;
};

}  // namespace stillpoint
