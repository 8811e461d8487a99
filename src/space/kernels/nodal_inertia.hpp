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

#include <stillpoint/problem.hpp>
#include <stillpoint/state_archive.hpp>

#include <array>
#include <vector>

#include "space/grid/extrapolation.hpp"

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

template <int Dim>
class NodalInertia {
 public:
  /// functions: must outlive this object.
  NodalInertia(const MassSpec& spec, bool updated_lagrangian, const GridFunctions<Dim>& functions)
      : spec_(spec), updated_lagrangian_(updated_lagrangian), functions_(functions) {}

  /// Sets the inertia of a phase. mass, G: m_i [kg] and the stiffness bound [N/m], (functions). is_free: whether
  /// neither support nor wall holds a function, (functions).
  void begin_phase(std::vector<double> mass, const std::vector<double>& G, const std::vector<char>& is_free);

  const std::vector<double>& mass() const { return mass_; }        // m_i, (functions) [kg]
  const std::vector<double>& inertia() const { return inertia_; }  // inertia against all motion, (functions) [kg]
  const std::vector<AddedInertia>& added() const { return added_; }
  /// The largest sum so far of the inertia that nodes were given beyond their mass, uniform scaling apart, as a share
  /// of the body's mass.
  double largest_added_mass() const { return largest_added_share_; }
  void archive(const StateArchive& state) { state("added_mass", largest_added_share_); }

 private:
  void find_light(const std::vector<double>& G, const std::vector<char>& is_free);

  MassSpec spec_;
  bool updated_lagrangian_;
  const GridFunctions<Dim>& functions_;
  std::vector<double> mass_, inertia_;
  std::vector<AddedInertia> added_;
  double omega_squared_ = 0;  // Ω², kept from the first phase [1/s²]
  double largest_added_share_ = 0;
};

}  // namespace stillpoint
