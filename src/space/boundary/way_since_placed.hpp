// How the material of bodies that another run has left was moved there, at places of the shapes that they were placed
// with: their borders are known by these shapes alone.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "space/grid/grid.hpp"

namespace stillpoint {

template <Kinematics K>
class CarriedBodyOf;  // carried_body.hpp

template <int Dim>
struct WaySincePlaced {
  Point<Dim> u;                               // displacement [m]
  std::array<double, Dim * Dim> area_factor;  // cof F, row by row, by which an area n da becomes another

  /// What the area has become.
  std::array<double, Dim> area(const std::array<double, Dim>& placed) const {
    std::array<double, Dim> now{};
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t j = 0; j < Dim; ++j) now[i] += area_factor[Dim * i + j] * placed[j];
    return now;
  }
};

template <int Dim>
class WaysSincePlaced {
 public:
  virtual ~WaysSincePlaced() = default;
  /// At an undeformed position X on the border of a body of the scene; empty if the body is placed now. Throws
  /// SceneError if the other run placed no point of it within a cell and a half of X.
  virtual std::optional<WaySincePlaced<Dim>> at(std::size_t body, const Point<Dim>& X) const = 0;
  /// Whether points, and weights, have stayed in place, as at small strain.
  virtual bool in_place() const = 0;
};

/// Fitted to the displacements of the points around a place by polynomials of degree 2 (points_around.hpp), which are
/// extrapolated at a border. All arguments must outlive the ways.
template <Kinematics K>
std::unique_ptr<const WaysSincePlaced<dimensions(K)>> ways_since_placed(const Problem& problem,
                                                                        const CarriedBodyOf<K>& carried,
                                                                        const Grid<dimensions(K)>& grid);

}  // namespace stillpoint
