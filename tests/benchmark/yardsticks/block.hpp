// A block of soil of equal cells, each full of points: its nodes, and how a step takes them on.
//
//   M a = F − R + D,   D = −α |F − R| sign(v)   (local damping),   v += h a,   Δu = h v   (leapfrog)
//
// The gradients at the points are those of the beginning. A step's increment Δu is all that its forces R depend on,
// besides the stresses before it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "soil.hpp"
#include "yardstick.hpp"

namespace yardsticks {

/// The cells, from below to above along the axis y, and their functions: linear (degree 1), or quadratic B-splines (2).
struct Grid {
  int dim, degree;
  std::array<int, 3> cells;  // 1 along an axis that the body does not have
  double side;               // [m]
  int stride;                // numbers at a node: its components, and what fills a register

  int nodes(int axis) const { return axis < dim ? cells[axis] + degree : 1; }
  std::size_t nodes() const {
    return static_cast<std::size_t>(nodes(0)) * static_cast<std::size_t>(nodes(1)) * static_cast<std::size_t>(nodes(2));
  }
  std::size_t node(int i, int j, int k = 0) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(nodes(0)) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(nodes(1)) * static_cast<std::size_t>(k));
  }
  std::size_t cell_count() const {
    return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(cells[2]);
  }
};

/// What a law knows of a point. The stress is xx, yy, zz, xy, yz, zx [Pa].
struct PointState {
  std::array<double, 3> place;  // in its cell, 0 to 1
  double volume;                // [m³]
  std::array<double, 6> stress;
  double plastic_strain;
};

class Block : public Yardstick {
 public:
  std::size_t points() const final { return grid_.cell_count() * static_cast<std::size_t>(1 << grid_.dim); }
  void step() final {
    forces();
    commit();
    move_nodes();
  }
  std::string wrong() final;

 protected:
  explicit Block(const Grid& grid);

  /// Puts points, under the stress of settled soil, at Gauss' places of each cell, and masses and loads at the nodes.
  void fill();

  /// Adds the forces R of the increment du to `R`, which is zero, and writes the history after it.
  virtual void forces() = 0;
  /// The history that forces() wrote is the one of the next step.
  virtual void commit() = 0;
  virtual PointState point(std::size_t cell, int of_cell) const = 0;
  virtual void set_point(std::size_t cell, int of_cell, const PointState& state) = 0;

  Grid grid_;
  std::vector<double> du_, R_;  // (nodes × stride) [m], [N]

 private:
  void move_nodes();

  double h_;                             // [s]
  std::vector<double> v_, load_, rate_;  // [m/s], [N], and h/M, none at a node that is held [s/kg]
};

}  // namespace yardsticks
