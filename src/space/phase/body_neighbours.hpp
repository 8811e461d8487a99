// Bodies that reach the same functions of the grid without touching each other: those that share them it moves as one,
// across the gap; others, in fields of their own, go through each other unless they have a contact.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <vector>

#include "scene/body_depth.hpp"
#include "space/kernels/point_functions.hpp"
#include "space/kernels/shared_corners.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

template <int Dim>
class BodyNeighbours {
 public:
  /// All arguments belong to the phase that begins, and must outlive this object; first_number: the number of the first
  /// point of each body, and the number of all points.
  BodyNeighbours(const Problem& problem, const GridFunctions<Dim>& functions, const MaterialPoints<Dim>& points,
                 const PointFunctions<Dim>& weights, const std::vector<int>& first_number, const Ranks* ranks)
      : problem_(problem),
        functions_(functions),
        grid_(functions.grid()),
        points_(points),
        weights_(weights),
        first_number_(first_number),
        ranks_(ranks) {}

  /// The gaps of all such pairs. at_start: whether bodies are in their initial positions, so that their surfaces are
  /// known.
  std::vector<BodyGap> find(bool at_start) const;
  /// The bodies that each function reaches, in ascending order.
  std::vector<std::vector<std::size_t>> bodies_of_functions() const;

 private:
  // A point of a cell that shares functions with another body.
  struct Near {
    CellPlace of;
    std::size_t body = 0;
    Point<Dim> x{};
  };
  std::vector<Near> points_near_others(const std::vector<std::vector<std::size_t>>& bodies) const;
  BodyGap gap_between(std::size_t a, std::size_t b, const std::vector<Near>& points,
                      const std::vector<BodyDepth>* shapes) const;
  static double distance(const Near& p, const Near& q);
  // The length along an axis of the cell in which a point is, in the grid at the start.
  double cell_length(int d, const Near& p) const;
  double half_spacing(const Near& p) const;
  double gap_along(const Near& p, const Near& q, const BodyDepth& a, const BodyDepth& b) const;

  const Problem& problem_;
  const GridFunctions<Dim>& functions_;
  const Grid<Dim>& grid_;
  const MaterialPoints<Dim>& points_;
  const PointFunctions<Dim>& weights_;
  const std::vector<int>& first_number_;
  const Ranks* ranks_;
};

}  // namespace stillpoint
