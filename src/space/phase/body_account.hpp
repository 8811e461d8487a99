// The data of a body and of its points for output, independent of the basis.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"
#include "space/points/body.hpp"

namespace stillpoint {

/// P: the number of points that the body was filled with; the values of a point that was split are the mean or sum over
/// its parts.
template <Kinematics K>
class BodyAccount {
  static constexpr int dim = dimensions(K);

 public:
  /// All arguments must outlive this object.
  BodyAccount(const Problem& problem, const Grid<dim>& grid, const Body<K>& body)
      : problem_(problem), grid_(grid), body_(body) {}

  /// held_by_springs: whether a support holds by springs, which move with the body from phase to phase.
  PhaseInfo describe(bool held_by_springs) const;
  /// The arrays of all points: `of_phase`, and those that laws store, each weighted by its share of the points.
  std::vector<PointArray> arrays(std::size_t P, const std::vector<PointArray>& of_phase) const;
  /// The positions of the points, (P × dim).
  std::vector<double> positions(std::size_t P) const;
  /// origin: positions at the start of the run, (P × dim); empty if points do not move on.
  PointData point_data(std::size_t P, const std::vector<double>& origin) const;
  /// Writes one of PhaseInfo::history_names, (P).
  void history(const std::string& name, Vec out) const;
  /// The place of point p in occupied cell k.
  PlaceInBody place(std::size_t k, std::size_t p) const;
  /// The time of a wave through half the smallest cell, h/2 √(ρ/A) with the undeformed modulus A: about 1/omega_max
  /// [s].
  double shortest_time() const;

 private:
  bool moves_on() const { return !body_.points.v[0].empty(); }

  const Problem& problem_;
  const Grid<dim>& grid_;
  const Body<K>& body_;
};

/// Sets the initial stress of a scene that has one: σ_yy = −ρ b_y (surface − y) from ∂σ_yy/∂y + ρ b_y = 0, σ_xx = σ_zz
/// = K0 σ_yy.
template <Kinematics K>
void set_geostatic_stress(const Problem& problem, Body<K>& body);
template <Kinematics K>
void set_initial_velocity(const Problem& problem, Body<K>& body);

}  // namespace stillpoint
