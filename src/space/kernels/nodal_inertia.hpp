// The inertia of the grid's functions: their mass, scaled if the scene asks for it.
//
// In a body that moves on, points come to lie next to a cell's edge and give nodes across it stiffness but hardly any
// mass: their frequencies would shorten the step without bound, or make the run diverge. Such a node gets inertia
// beyond its mass m_i until its stiffness bound G_i is no more than `most` times as high as in the body as a whole when
// the run began,
//
//   M_i = m_i + δ_i,   δ_i = max(0, G_i/(most Ω²) − m_i),   Ω² = Σ G_i/Σ m_i,
//
// where δ_i acts against motion relative to the extrapolation from nodes further inside, ½ δ_i (v_i − Σ_k w_k v_k)²:
// rigid motions are not affected, and linear and angular momentum are those of the masses m_i [selective mass scaling,
// Olovsson, Simonsson and Unosson 2005]. Where there is nothing to extrapolate from, such as next to supports and
// walls, it acts against all motion.
//
// With scaling by Gershgorin, every node has the same bound instead: M_i = G_i/Ω², whose sum is the body's mass.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "space/grid/extrapolation.hpp"
#include "space/kernels/extended_sums.hpp"

namespace stillpoint {

/// Inertia of a function beyond its mass, against motion relative to others.
struct AddedInertia {
  int function = 0;
  double inertia = 0;           // δ_i [kg]
  Extrapolation relative_to{};  // no functions: against all motion
};

/// The deviation x_i − Σ_k w_k x_k of values x over the grid's functions, (functions × Dim).
template <int Dim>
Point<Dim> deviation(const std::vector<double>& x, const AddedInertia& added) {
  const auto at = [&](int function, std::size_t i) { return x[Dim * static_cast<std::size_t>(function) + i]; };
  Point<Dim> d;
  for (std::size_t i = 0; i < Dim; ++i) d[i] = at(added.function, i);
  for (std::size_t k = 0; k < static_cast<std::size_t>(added.relative_to.functions); ++k) {
    for (std::size_t i = 0; i < Dim; ++i) d[i] -= added.relative_to.weight[k] * at(added.relative_to.function[k], i);
  }
  return d;
}

template <AxisBasis B, Kinematics K>
class NodalInertia {
  static constexpr int dim = dimensions(K);

 public:
  NodalInertia(const MassSpec& spec, bool updated_lagrangian) : spec_(spec), updated_lagrangian_(updated_lagrangian) {}

  /// Sets the inertia of a phase. mass, G: m_i [kg] and the stiffness bound [N/m], (functions). is_free: whether
  /// neither support nor wall holds a function, (functions).
  void begin_phase(const Grid<dim>& grid, std::vector<double> mass, const std::vector<double>& G,
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
      find_light(grid, G, is_free);
    }
    double added = 0;
    for (std::size_t f = 0; gershgorin && f < mass_.size(); ++f) added += std::max(0.0, inertia_[f] - mass_[f]);
    for (const AddedInertia& one : added_) added += one.inertia;
    largest_added_share_ = std::max(largest_added_share_, added / all_mass);
    for (double& inertia : inertia_) inertia *= spec_.factor;
    for (AddedInertia& one : added_) one.inertia *= spec_.factor;
  }

  const std::vector<double>& mass() const { return mass_; }        // m_i, (functions) [kg]
  const std::vector<double>& inertia() const { return inertia_; }  // inertia against all motion, (functions) [kg]
  const std::vector<AddedInertia>& added() const { return added_; }
  /// The largest sum so far of the inertia that nodes were given beyond their mass, uniform scaling apart, as a share
  /// of the body's mass.
  double largest_added_mass() const { return largest_added_share_; }
  void archive(const StateArchive& state) { state("added_mass", largest_added_share_); }

 private:
  // Finds light nodes; in a single phase only those with next to no mass: points on a grid line reach the nodes across
  // a cell by their gradients alone.
  void find_light(const Grid<dim>& grid, const std::vector<double>& G, const std::vector<char>& is_free) {
    constexpr double most = 1.2;       // a tenth above the highest frequency: within the margin of the step
    constexpr double massless = 1e-9;  // share of G/Ω²
    std::vector<double> share(mass_.size());
    for (std::size_t f = 0; f < mass_.size(); ++f) {
      const double needed = G[f] / (most * omega_squared_);
      const double enough = updated_lagrangian_ ? needed : massless * needed;
      if (is_free[f] && needed > 0) share[f] = mass_[f] / enough;
      if (mass_[f] < enough) added_.push_back({.function = static_cast<int>(f), .inertia = needed - mass_[f]});
    }
    if constexpr (B::partition_of_unity) {
      const Extrapolator<B, dim> extrapolate(grid, share);
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
  }

  MassSpec spec_;
  bool updated_lagrangian_;
  std::vector<double> mass_, inertia_;
  std::vector<AddedInertia> added_;
  double omega_squared_ = 0;  // Ω², kept from the first phase [1/s²]
  double largest_added_share_ = 0;
};

}  // namespace stillpoint
