// The frozen weights N_ip and gradients ∇N_ip of a phase.
#pragma once

#include <stillpoint/basis.hpp>
#include <stillpoint/material.hpp>
#include <stillpoint/material_points.hpp>
#include <stillpoint/types.hpp>

#include <array>
#include <vector>

#include "deformation.hpp"
#include "degrees_of_freedom.hpp"
#include "parallel_loop.hpp"

namespace stillpoint {

/// All weights of a point lie together: the loops over cells go from point to point and take the local functions of one
/// at a time. A row of gradients is ∂N_a/∂x_j for one j, and where axisymmetric the last row is N_a/r.
template <AxisBasis B, Kinematics K>
class PointWeights {
 public:
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;
  static constexpr int per_cell = Basis::per_cell;
  static constexpr int slack = 4;  // entries after the last, for who reads a few at a time
  static constexpr int rows = K == Kinematics::axisymmetric ? dim + 1 : dim;

  void rebuild(const Grid<dim>& grid, const MaterialPoints<dim>& points) {
    offset_ = Basis::offsets(grid);
    first_.resize(points.cells());
    N_.resize(per_cell * points.size());
    dN_.resize(rows * per_cell * points.size() + slack);
    for_each_block(points.cells(), [&](std::size_t k) {
      const auto cell = grid.cell_at(points.cell[k]);
      first_[k] = Basis::first(grid, cell);
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        const auto values = Basis::evaluate(grid, cell, points.place(p));
        double* N = N_.data() + per_cell * p;
        double* dN = dN_.data() + rows * per_cell * p;
        for (int a = 0; a < per_cell; ++a) {
          N[a] = values.N[a];
          for (int j = 0; j < dim; ++j) dN[per_cell * j + a] = values.dN[j][a];
          if constexpr (rows > dim) dN[per_cell * dim + a] = values.N[a] / points.x[0][p];
        }
      }
    });
  }

  /// Grid number of local function a in occupied cell k.
  int function(std::size_t k, int a) const { return first_[k] + offset_[a]; }
  /// (per_cell) and (rows × per_cell) of point p.
  const double* N(std::size_t p) const { return N_.data() + per_cell * p; }
  const double* dN(std::size_t p) const { return dN_.data() + rows * per_cell * p; }

  /// F_a += N_ap value, in one component, at the free degrees of freedom; F: (n).
  void add_at_functions(std::size_t k, std::size_t p, int component, double value, const DegreesOfFreedom& dofs,
                        Vec F) const {
    for (int a = 0; a < per_cell; ++a) {
      const int dof = dofs.number[static_cast<std::size_t>(dim * function(k, a) + component)];
      if (dofs.is_free(dof)) F[static_cast<std::size_t>(dof)] += value * N(p)[a];
    }
  }
  /// Σ_a N_ap u_a at point p of cell k; u over the grid's functions, component i at [dim function + i].
  std::array<double, dim> value(const double* u, std::size_t k, std::size_t p) const {
    std::array<double, dim> sum{};
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < dim; ++i) sum[i] += u[dim * function(k, a) + i] * N(p)[a];
    }
    return sum;
  }
  /// H_ij = Σ_a u_a,i ∂N_a/∂x_j, and H_θθ = Σ_a u_a,r N_a/r
  TensorOf<K> gradient(const double* u, std::size_t k, std::size_t p) const {
    TensorOf<K> H{};
    for (int a = 0; a < per_cell; ++a) {
      const double* of_function = u + dim * function(k, a);
      for (int i = 0; i < dim; ++i) {
        for (int j = 0; j < dim; ++j) H[dim * i + j] += of_function[i] * dN(p)[per_cell * j + a];
      }
      if constexpr (rows > dim) H[dim * dim] += of_function[0] * dN(p)[per_cell * dim + a];
    }
    return H;
  }

 private:
  std::array<int, per_cell> offset_;
  std::vector<int> first_;  // (occupied cells)
  std::vector<double> N_;   // (P × per_cell)
  std::vector<double> dN_;  // (P × rows × per_cell) [1/m]
};

}  // namespace stillpoint
