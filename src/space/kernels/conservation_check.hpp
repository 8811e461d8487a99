// Keeps account of mass and momentum on their way between material points and grid.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "base/parallel_loop.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

template <int Dim>
class ConservationCheck {
 public:
  struct Momentum {
    std::array<double, Dim> sum{};  // Σ_p m_p v_p [kg m/s]
    double scale = 0;               // Σ_p m_p |v_p|
  };
  static Momentum of_points(const MaterialPoints<Dim>& points) {
    Momentum momentum;
    const auto& m = points.mass;
    for (int i = 0; i < Dim; ++i) {
      const auto& v = points.v[i];
      momentum.sum[i] = sum_over(points.size(), [&](std::size_t p) { return m[p] * v[p]; });
      momentum.scale += sum_over(points.size(), [&](std::size_t p) { return m[p] * std::abs(v[p]); });
    }
    return momentum;
  }

  /// The nodes' masses, (functions), beside the body's when the run began.
  void compare_mass(double body, const std::vector<double>& at_nodes) {
    const double sum = sum_over(at_nodes.size(), [&](std::size_t f) { return at_nodes[f]; });
    mass_ = std::max(mass_, std::abs(sum - body) / body);
  }
  /// Momenta at the nodes, (functions × Dim), beside those of the points.
  void compare_momentum(const Momentum& of_points, const std::vector<double>& at_nodes) {
    if (!(of_points.scale > 0)) return;
    for (int i = 0; i < Dim; ++i) {
      const double sum = sum_over(at_nodes.size() / Dim, [&](std::size_t f) { return at_nodes[Dim * f + i]; });
      momentum_ = std::max(momentum_, std::abs(sum - of_points.sum[i]) / of_points.scale);
    }
  }
  double mass() const { return mass_; }
  double momentum() const { return momentum_; }

 private:
  double mass_ = 0, momentum_ = 0;  // the worst so far, relative
};

}  // namespace stillpoint
