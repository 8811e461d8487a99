// The data of a body and of its points for output, independent of the basis.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/points/body.hpp"

namespace stillpoint {

/// P: the number of points that the body was filled with; the values of a point that was split are the mean or sum over
/// its parts.
template <Kinematics K>
class BodyAccount {
  static constexpr int dim = dimensions(K);

 public:
  /// All arguments must outlive this object. ranks: that share the points.
  BodyAccount(const Problem& problem, const Grid<dim>& grid, const Body<K>& body, const Ranks* ranks)
      : problem_(problem), grid_(grid), body_(body), ranks_(ranks) {}

  /// total_mass: of the points of all ranks [kg]; held_by_springs: whether a support holds by springs, which move with
  /// the body from phase to phase.
  PhaseInfo describe(double total_mass, bool held_by_springs) const;
  /// The arrays of all points: `of_phase`, and those that laws store, each weighted by its share of the points.
  std::vector<PointArray> arrays(const std::vector<PointArray>& of_phase) const;
  /// The positions of the points, (P × dim).
  std::vector<double> positions() const;
  /// The mass of the points that are here [kg].
  double total_mass() const;
  /// origin: positions at the start of the run, (P × dim); empty if points do not move on.
  PointData point_data(const std::vector<double>& origin) const;
  /// Writes a field of PhaseFields::point_history(), (P).
  void history(const std::string& name, Vec out) const;
  /// The largest stress of a viscous law beyond its strength; empty: no law is viscous.
  std::optional<OverStress> over_stress() const;
  /// The place of point p in occupied cell k, and that of the point with a number.
  PlaceInBody place(std::size_t k, std::size_t p) const;
  PlaceInBody place_of(std::size_t number) const;
  /// The time of a wave through half the smallest cell, h/2 √(ρ/A) with the undeformed modulus A: about 1/omega_max
  /// [s].
  double shortest_time() const;

 private:
  bool moves_on() const { return problem_.phase.ends(); }

  const Problem& problem_;
  const Grid<dim>& grid_;
  const Body<K>& body_;
  const Ranks* ranks_;
};

/// Writes value_at(occupied cell, point), an array, to out at each point's number; for a point in parts their mean.
/// Where ranks share the points, all get the values of all.
template <Kinematics K, class ValueAt>
void write_points(const Body<K>& body, const Ranks* ranks, Vec out, const ValueAt& value_at) {
  const MaterialPoints<dimensions(K)>& points = body.points;
  if (points.size() == body.numbers() || ranks) {
    if (ranks) std::ranges::fill(out, 0.0);
    for_points(points, [&](std::size_t k, std::size_t p, std::size_t number) {
      const auto value = value_at(k, p);
      std::copy(value.begin(), value.end(), out.begin() + static_cast<std::ptrdiff_t>(value.size() * number));
    });
    return unite(ranks, out);
  }
  std::vector<double> mass(body.numbers(), 0);
  for_points(points, [&](std::size_t, std::size_t p, std::size_t number) { mass[number] += points.mass[p]; });
  std::ranges::fill(out, 0.0);
  for_points(points, [&](std::size_t k, std::size_t p, std::size_t number) {
    const auto value = value_at(k, p);
    const double share = points.mass[p] / mass[number];
    for (std::size_t i = 0; i < value.size(); ++i) out[value.size() * number + i] += share * value[i];
  });
}

}  // namespace stillpoint
