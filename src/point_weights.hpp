// The frozen weights N_ip and gradients ∇N_ip of a phase, as structure of arrays over points.
#pragma once

#include <stillpoint/basis.hpp>
#include <stillpoint/material.hpp>
#include <stillpoint/material_points.hpp>

#include <vector>

namespace stillpoint {

template <AxisBasis B, int Dim>
class PointWeights {
 public:
  using Basis = TensorBasis<B, Dim>;
  static constexpr int per_cell = Basis::per_cell;

  PointWeights(const Grid<Dim>& grid, const MaterialPoints<Dim>& points) : offset_(Basis::offsets(grid)) {
    const std::size_t n = points.size();
    first_.resize(n);
    for (auto& N : N_) N.resize(n);
    for (auto& direction : dN_) {
      for (auto& dN : direction) dN.resize(n);
    }
    for (std::size_t k = 0; k < points.cell.size(); ++k) {
      const auto cell = grid.cell_at(points.cell[k]);
      for (int q = points.cell_begin[k]; q < points.cell_begin[k + 1]; ++q) {
        const auto p = static_cast<std::size_t>(q);
        const auto values = Basis::evaluate(grid, cell, points.place(p));
        first_[p] = Basis::first(grid, cell);
        for (int a = 0; a < per_cell; ++a) {
          N_[a][p] = values.N[a];
          for (int d = 0; d < Dim; ++d) dN_[d][a][p] = values.dN[d][a];
        }
      }
    }
  }

  /// Global number of point p's local function a.
  int function(std::size_t p, int a) const {
    if constexpr (Dim == 1) return first_[p] + a;  // contiguous: known to the compiler
    return first_[p] + offset_[a];
  }
  double N(int a, std::size_t p) const { return N_[a][p]; }
  double dN(int d, int a, std::size_t p) const { return dN_[d][a][p]; }

  /// Σ_a N_ap u_a; u over the grid's functions, component i at [Dim function + i].
  std::array<double, Dim> value(const double* u, std::size_t p) const {
    std::array<double, Dim> sum{};
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < Dim; ++i) sum[i] += u[Dim * function(p, a) + i] * N_[a][p];
    }
    return sum;
  }
  /// H_ij = Σ_a u_a,i ∂N_a/∂x_j
  Tensor<Dim> gradient(const double* u, std::size_t p) const {
    Tensor<Dim> H{};
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) H[Dim * i + j] += u[Dim * function(p, a) + i] * dN_[j][a][p];
      }
    }
    return H;
  }

 private:
  std::array<int, per_cell> offset_;
  std::vector<int> first_;                                         // (P)
  std::array<std::vector<double>, per_cell> N_;                    // (per_cell × P)
  std::array<std::array<std::vector<double>, per_cell>, Dim> dN_;  // (Dim × per_cell × P) [1/m]
};

}  // namespace stillpoint
