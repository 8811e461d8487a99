// The frozen weights N_ip and gradients ∇N_ip of a phase.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/types.hpp>

#include <array>
#include <concepts>
#include <vector>

#include "base/lanes.hpp"
#include "base/memory_report.hpp"
#include "base/parallel_loop.hpp"
#include "space/grid/basis.hpp"
#include "space/kernels/point_functions.hpp"
#include "space/materials/deformation.hpp"
#include "space/points/material_points.hpp"
#include "space/points/point_domains.hpp"

namespace stillpoint {

/// The weights of the points. All weights of a point are contiguous: the loops over cells go from point to point and
/// take the local functions of one at a time. A row of gradients is ∂N_a/∂x_j for one j, and if axisymmetric the last
/// row is N_a/r.
///
/// Linear functions in the plane and in space are recomputed where they are needed, from the position of a point in its
/// cell: that is less work than to read them from memory, and takes an eighth of the memory or less. In space not even
/// the position in the cell is stored, but computed from the point's position by one product: the points do not move
/// before the next rebuild(). For other functions in space the factors along each axis are stored, 18 numbers for 27
/// functions and their gradients, which are products of the factors.
template <AxisBasis B, Kinematics K>
class PointWeights final : public PointFunctions<dimensions(K)> {
 public:
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;
  static constexpr int per_cell = Basis::per_cell;
  static constexpr int slack = 8;  // entries after the last, for loops that read a few at a time
  static constexpr int rows = K == Kinematics::axisymmetric ? dim + 1 : dim;
  static constexpr bool from_positions = dim > 1 && std::same_as<B, BSpline<1>>;
  static constexpr bool from_factors = dim == 3 && !from_positions;
  static constexpr bool keeps_positions = from_positions && dim < 3;

  /// A cell's corner and sides, by which its linear functions are computed.
  struct Cell {
    Point<dim> left, side, inverse_side;  // [m], [m], [1/m]
  };

  PointWeights() : PointFunctions<dim>(per_cell) {}

  void rebuild(const Grid<dim>& grid, const MaterialPoints<dim>& points) {
    rebuild(grid, points, [](std::size_t) {});
  }
  /// after(k) is called after the weights of occupied cell k, while they are in the cache; for several cells in
  /// parallel.
  template <class After>
  void rebuild(const Grid<dim>& grid, const MaterialPoints<dim>& points, const After& after) {
    points_ = &points;
    std::ranges::copy(Basis::offsets(grid), offset_.begin());
    const int of_field = Basis::count(grid);
    first_.resize(points.cells());
    at_.resize(points.cells());
    if constexpr (from_positions) {
      cell_.resize(points.cells());
      for (auto& along : position_) along.resize(keeps_positions ? points.size() + slack : 0);
    } else if constexpr (from_factors) {
      for (auto& factor : factor_) factor.resize(points.size() + slack);
    } else {
      N_.resize(per_cell * points.size());
      dN_.resize(rows * per_cell * points.size() + slack);
    }
    const auto functions = [&] {
      if constexpr (from_positions || B::window > 1) {
        return 0;
      } else {
        return typename Basis::OnCells(grid);
      }
    }();
    for_each_block(points.cells(), [&](std::size_t k) {
      const auto cell = at_[k] = grid.cell_at(points.cell[k]);
      first_[k] = points.field_of_cell(k) * of_field + Basis::first(grid, cell);
      if constexpr (from_positions) {
        locate_in_cell(grid, cell, points, k);
      } else if constexpr (from_factors) {
        find_factors(functions, cell, points, k);
      } else {
        evaluate_in_cell(grid, functions, cell, points, k);
      }
      after(k);
    });
  }

  /// The values N_a of point p in occupied cell k, [a] (per_cell).
  auto N([[maybe_unused]] std::size_t k, std::size_t p) const {
    if constexpr (from_positions && dim == 3) {
      return trilinear(k, p).N;
    } else if constexpr (from_factors) {
      return products(p).N;
    } else if constexpr (from_positions) {
      const double x = position_[0][p], y = position_[1][p];
      return std::array{(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    } else {
      return N_.data() + per_cell * p;
    }
  }
  /// The gradients at point p in occupied cell k, [per_cell row + a] (rows × per_cell).
  auto dN([[maybe_unused]] std::size_t k, std::size_t p) const {
    if constexpr (from_positions && dim == 3) {
      std::array<double, rows * per_cell> of_point;
      const auto values = trilinear(k, p);
      for (int j = 0; j < dim; ++j) {
        for (int a = 0; a < per_cell; ++a)
          of_point[per_cell * j + a] = values.dN[j][a] * cell_[k].inverse_side[static_cast<std::size_t>(j)];
      }
      return of_point;
    } else if constexpr (from_factors) {
      const auto values = products(p);
      std::array<double, rows * per_cell> of_point;
      for (int j = 0; j < dim; ++j) std::ranges::copy(values.dN[j], of_point.begin() + per_cell * j);
      return of_point;
    } else if constexpr (from_positions) {
      const double x = position_[0][p], y = position_[1][p];
      const auto [per_x, per_y] = cell_[k].inverse_side;
      std::array<double, rows * per_cell> of_point{-(1 - y) * per_x, (1 - y) * per_x, -y * per_x,      y * per_x,
                                                   -(1 - x) * per_y, -x * per_y,      (1 - x) * per_y, x * per_y};
      if constexpr (rows > dim) {
        const auto values = N(k, p);
        for (int a = 0; a < per_cell; ++a)
          of_point[per_cell * dim + a] = values[a] / (cell_[k].left[0] + x * cell_[k].side[0]);
      }
      return of_point;
    } else {
      return dN_.data() + rows * per_cell * p;
    }
  }
  /// The arrays that are stored for each point.
  static std::vector<PointArray> arrays() {
    constexpr double real = sizeof(double);
    if constexpr (keeps_positions) return {{"position in the cell", dim * real}};
    if constexpr (from_positions) return {};
    if constexpr (from_factors) return {{"factors of N and its slopes", 2 * dim * B::per_cell * real}};
    return {{"weights N", per_cell * real}, {"gradients of N", rows * per_cell * real}};
  }
  /// The position of point p of occupied cell k in the cell along an axis, 0 to 1; only if from_positions.
  double position_in_cell(std::size_t axis, std::size_t k, std::size_t p) const {
    if constexpr (keeps_positions) return position_[axis][p];
    return (points_->x[axis][p] - cell_[k].left[axis]) * cell_[k].inverse_side[axis];
  }
  /// The distances from the cell's corner of eight points from p on [m]; the values of points past the end of the cell
  /// are arbitrary.
  [[gnu::always_inline]] Lanes<8> eight_from_corner(std::size_t axis, std::size_t k, std::size_t p) const {
    const auto x = Lanes<8>::load_first(points_->x[axis].data() + p, points_->size() - p);
    return x.plus(-cell_[k].left[axis]);
  }
  /// The positions in their cells of all points, (P + slack); only if keeps_positions.
  const double* position_in_cell(int axis) const { return position_[static_cast<std::size_t>(axis)].data(); }
  const Cell& cell(std::size_t k) const { return cell_[k]; }
  /// The a-th function of the cell along an axis and its derivative at each point, (P + slack); only if from_factors.
  const double* factor(int axis, int a) const { return factor_[number_of_factor(axis, a)].data(); }
  const double* slope(int axis, int a) const { return factor_[number_of_factor(axis, B::per_cell + a)].data(); }

  /// The value Σ_a N_ap u_a at point p of cell k; u over the grid's functions, component i at [dim function + i].
  std::array<double, dim> value(const double* u, std::size_t k, std::size_t p) const {
    const auto values = N(k, p);
    std::array<double, dim> sum{};
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < dim; ++i) sum[i] += u[dim * this->function(k, a) + i] * values[a];
    }
    return sum;
  }
  /// The displacement gradient H_ij = Σ_a u_a,i ∂N_a/∂x_j, with H_θθ = Σ_a u_a,r N_a/r.
  TensorOf<K> gradient(const double* u, std::size_t k, std::size_t p) const {
    const auto gradients = dN(k, p);
    TensorOf<K> H{};
    for (int a = 0; a < per_cell; ++a) {
      const double* of_function = u + dim * this->function(k, a);
      for (int i = 0; i < dim; ++i) {
        for (int j = 0; j < dim; ++j) H[dim * i + j] += of_function[i] * gradients[per_cell * j + a];
      }
      if constexpr (rows > dim) H[dim * dim] += of_function[0] * gradients[per_cell * dim + a];
    }
    return H;
  }

  void values(std::size_t k, std::size_t p, typename PointFunctions<dim>::Numbers& of_point) const override {
    const auto found = N(k, p);
    for (int a = 0; a < per_cell; ++a) of_point[a] = found[a];
  }
  void slopes(std::size_t k, std::size_t p, typename PointFunctions<dim>::Slopes& of_point) const override {
    const auto found = dN(k, p);
    for (int i = 0; i < dim * per_cell; ++i) of_point[i] = found[i];
  }

 private:
  // The trilinear functions of the eight corners, in a cell of unit sides.
  auto trilinear(std::size_t k, std::size_t p) const {
    Point<dim> position;
    for (std::size_t d = 0; d < dim; ++d) position[d] = position_in_cell(d, k, p);
    typename Basis::Values values;
    for (int a = 0; a < per_cell; ++a) {
      Point<dim> factor, sign;
      for (std::size_t d = 0; d < dim; ++d) {
        const bool far = Basis::axis_index(a, static_cast<int>(d)) == 1;
        factor[d] = far ? position[d] : 1 - position[d];
        sign[d] = far ? 1 : -1;
      }
      values.N[a] = factor[0] * factor[1] * factor[2];
      values.dN[0][a] = sign[0] * factor[1] * factor[2];
      values.dN[1][a] = factor[0] * sign[1] * factor[2];
      values.dN[2][a] = factor[0] * factor[1] * sign[2];
    }
    return values;
  }

  static constexpr std::size_t number_of_factor(int axis, int k) {
    return static_cast<std::size_t>(2 * B::per_cell * axis + k);
  }
  auto products(std::size_t p) const {
    typename Basis::OfAxes N, dN;
    for (int d = 0; d < dim; ++d) {
      for (int a = 0; a < B::per_cell; ++a) {
        N[d][a] = factor(d, a)[p];
        dN[d][a] = slope(d, a)[p];
      }
    }
    typename Basis::Values values;
    Basis::multiply(N, dN, values.N.data(), values.dN[0].data());
    return values;
  }
  void find_factors(const typename Basis::OnCells& functions, const std::array<int, dim>& cell,
                    const MaterialPoints<dim>& points, std::size_t k) {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      typename Basis::OfAxes N, dN;
      functions.evaluate_factors(cell, points.position(p), N, dN);
      for (int d = 0; d < dim; ++d) {
        for (int a = 0; a < B::per_cell; ++a) {
          factor_[number_of_factor(d, a)][p] = N[d][a];
          factor_[number_of_factor(d, B::per_cell + a)][p] = dN[d][a];
        }
      }
    }
  }

  // functions: those of all cells of the grid; unused where points take means over their domains.
  template <class Functions>
  void evaluate_in_cell(const Grid<dim>& grid, const Functions& functions, const std::array<int, dim>& cell,
                        const MaterialPoints<dim>& points, std::size_t k) {
    for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
      double* N = N_.data() + per_cell * p;
      double* dN = dN_.data() + rows * per_cell * p;
      if constexpr (B::window == 1) {
        functions.evaluate(cell, points.position(p), N, dN);
      } else {
        const auto mean = mean_over_domain(grid, cell, points, p);
        std::copy(mean.N.begin(), mean.N.end(), N);
        for (int j = 0; j < dim; ++j) std::copy(mean.dN[j].begin(), mean.dN[j].end(), dN + per_cell * j);
      }
      if constexpr (rows > dim) {
        for (int a = 0; a < per_cell; ++a) dN[per_cell * dim + a] = N[a] / points.x[0][p];
      }
    }
  }
  static typename Basis::Values mean_over_domain(const Grid<dim>& grid, const std::array<int, dim>& cell,
                                                 const MaterialPoints<dim>& points, std::size_t p) {
    const auto domain = Domain<dim>::in_grid(points, p, grid);
    const auto S = domain.gradients();
    typename Basis::Values mean{};
    for (int c = 0; c < domain.corners; ++c) {
      const auto at_corner = Basis::evaluate(grid, cell, domain.x[c]);
      for (int a = 0; a < per_cell; ++a) {
        mean.N[a] += at_corner.N[a] / domain.corners;
        for (int j = 0; j < dim; ++j) mean.dN[j][a] += S[c][j] * at_corner.N[a];
      }
    }
    return mean;
  }
  void locate_in_cell(const Grid<dim>& grid, const std::array<int, dim>& at, const MaterialPoints<dim>& points,
                      std::size_t k) {
    Cell& cell = cell_[k];
    for (std::size_t d = 0; d < dim; ++d) {
      const std::vector<double>& lines = grid.axes[d].nodes;
      const auto line = static_cast<std::size_t>(at[d]);
      cell.left[d] = lines[line];
      cell.side[d] = lines[line + 1] - lines[line];
      cell.inverse_side[d] = 1 / cell.side[d];
      if constexpr (!keeps_positions) continue;
      constexpr int lanes = 4;
      const std::size_t end = points.end(k);
      for (std::size_t p = points.begin(k); p < end; p += lanes) {
        const auto x = Lanes<lanes>::load_first(points.x[d].data() + p, end - p);
        x.plus(-cell.left[d]).over(cell.side[d]).store_first(position_[d].data() + p, end - p);
      }
    }
  }

  using PointFunctions<dim>::offset_;
  using PointFunctions<dim>::at_;
  using PointFunctions<dim>::first_;

  const MaterialPoints<dim>* points_ = nullptr;
  // Either the functions are stored,
  std::vector<double> N_;   // (P × per_cell)
  std::vector<double> dN_;  // (P × rows × per_cell) [1/m]
  // or their ingredients: factors and slopes of each axis in turn, or positions.
  std::array<std::vector<double>, from_factors ? 2 * dim * B::per_cell : 0> factor_;
  std::array<std::vector<double>, dim> position_;
  std::vector<Cell> cell_;  // (occupied cells)
};

}  // namespace stillpoint
