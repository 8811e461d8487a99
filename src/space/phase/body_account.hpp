// What is told of a body and of its points, whatever the functions of the grid that moves it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"
#include "space/points/body.hpp"

namespace stillpoint {

/// P: how many points the body was filled with; of one that came into parts since then, their mean or sum is told.
template <Kinematics K>
class BodyAccount {
  static constexpr int dim = dimensions(K);

 public:
  /// All outlive it.
  BodyAccount(const Problem& problem, const Grid<dim>& grid, const Body<K>& body)
      : problem_(problem), grid_(grid), body_(body) {}

  /// held_by_springs: whether a support is, which go with a body from phase to phase.
  PhaseInfo describe(bool held_by_springs) const;
  /// What all points have, `of_phase`, and what laws keep, each for its share of the points.
  std::vector<PointArray> arrays(std::size_t P, const std::vector<PointArray>& of_phase) const;
  /// (P × dim)
  std::vector<double> positions(std::size_t P) const;
  /// origin: positions at the start of the run, (P × dim); none if points stay where they are.
  PointData point_data(std::size_t P, const std::vector<double>& origin) const;
  /// One of PhaseInfo::history_names, (P).
  void history(const std::string& name, Vec out) const;
  /// Of point p in occupied cell k.
  PlaceInBody place(std::size_t k, std::size_t p) const;
  /// A wave's time through half the smallest cell, h/2 √(ρ/A) with the undeformed modulus A: about 1/omega_max [s].
  double shortest_time() const;

 private:
  bool moves_on() const { return !body_.points.v[0].empty(); }

  const Problem& problem_;
  const Grid<dim>& grid_;
  const Body<K>& body_;
};

/// Of a scene that has it: σ_yy = −ρ b_y (surface − y) from ∂σ_yy/∂y + ρ b_y = 0, σ_xx = σ_zz = K0 σ_yy.
template <Kinematics K>
void set_geostatic_stress(const Problem& problem, Body<K>& body);
template <Kinematics K>
void set_initial_velocity(const Problem& problem, Body<K>& body);

}  // namespace stillpoint
