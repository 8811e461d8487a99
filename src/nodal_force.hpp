// Internal nodal forces from the stresses of the material points: the hot loop of every evaluation.
//
//   R_i = Σ_p V_p P_p ∇N_ip
//
// in two passes: cell by cell into the cell's corners, then corner by corner into the nodes, each in a fixed order, so
// that the bits do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <vector>

#include "degrees_of_freedom.hpp"
#include "point_weights.hpp"

namespace stillpoint {

template <AxisBasis B, int Dim>
class NodalForce {
  static constexpr int per_cell = PointWeights<B, Dim>::per_cell;
  static constexpr std::size_t corners = Dim * per_cell;  // a cell's corner forces
  static constexpr std::size_t tensor = Dim * Dim;
  static constexpr std::size_t block_points = 512;          // a block's stresses stay in the first-level cache
  static constexpr std::size_t points_for_threads = 16384;  // below, waking threads costs more than it saves

 public:
  NodalForce(const MaterialPoints<Dim>& points, const PointWeights<B, Dim>& weights, const DegreesOfFreedom& dofs)
      : corner_sum_(degrees_of_freedom_of_corners(points, weights, dofs), dofs.size() + dofs.prescribed.size()),
        corner_(corners * points.cell.size()),
        traction_(tensor * points.size()) {
    for (std::size_t k = 0; k < points.cell.size(); ++k) {
      const std::size_t begin = first_point(points, k);
      if (block_begin_.empty() || begin >= block_points + first_point(points, block_begin_.back())) {
        block_begin_.push_back(k);
      }
    }
    block_begin_.push_back(points.cell.size());
  }

  /// First pass; stress_at(p) gives P at point p, (Dim × Dim) [Pa]. False where some P is not finite.
  template <class Stress>
  bool gather(const MaterialPoints<Dim>& points, const PointWeights<B, Dim>& weights, const Stress& stress_at) {
    const double* V = points.volume.data();
    double* VP = traction_.data();
    const std::size_t n = points.size();
    const std::size_t blocks = block_begin_.size() - 1;
    double not_finite = 0;  // 0·P is 0 or NaN, so the loop needs no branch
#pragma omp parallel for schedule(static) reduction(+ : not_finite) if (n > points_for_threads)
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t first_cell = block_begin_[block], last_cell = block_begin_[block + 1];
      const std::size_t begin = first_point(points, first_cell), end = first_point(points, last_cell);
      double bad = 0;
#pragma omp simd reduction(+ : bad)
      for (std::size_t p = begin; p < end; ++p) {
        const Tensor<Dim> P = stress_at(p);
        for (std::size_t ij = 0; ij < tensor; ++ij) {
          VP[n * ij + p] = V[p] * P[ij];
          bad += 0 * P[ij];
        }
      }
      not_finite += bad;
      for (std::size_t k = first_cell; k < last_cell; ++k) scatter_cell(k, points, weights);
    }
    return not_finite == 0;
  }

  /// Second pass: R of the free degrees of freedom, (n) [N].
  void sum(Vec R) const {
    const double* forces = corner_.data();
#pragma omp parallel for schedule(static) if (traction_.size() > points_for_threads)
    for (std::size_t k = 0; k < R.size(); ++k) R[k] = corner_sum_.sum(k, forces);
  }
  /// The force at one degree of freedom, free or (a reaction) prescribed [N].
  double at(std::size_t dof) const { return corner_sum_.sum(dof, corner_.data()); }

 private:
  static std::size_t first_point(const MaterialPoints<Dim>& points, std::size_t cell) {
    return static_cast<std::size_t>(points.cell_begin[cell]);
  }

  static std::vector<int> degrees_of_freedom_of_corners(const MaterialPoints<Dim>& points,
                                                        const PointWeights<B, Dim>& weights,
                                                        const DegreesOfFreedom& dofs) {
    std::vector<int> dof;
    for (std::size_t k = 0; k < points.cell.size(); ++k) {
      for (int a = 0; a < per_cell; ++a) {
        const int function = weights.function(first_point(points, k), a);
        for (int i = 0; i < Dim; ++i) dof.push_back(dofs.number[static_cast<std::size_t>(Dim * function + i)]);
      }
    }
    return dof;
  }

  // corner_[cell k, a, i] = Σ_p V_p P_ij ∂N_ap/∂x_j over the cell's points
  void scatter_cell(std::size_t k, const MaterialPoints<Dim>& points, const PointWeights<B, Dim>& weights) {
    const std::size_t begin = first_point(points, k), end = first_point(points, k + 1), n = points.size();
    double* force = corner_.data() + corners * k;
    for (int a = 0; a < per_cell; ++a) {
      for (int i = 0; i < Dim; ++i) {
        double total = 0;
        for (int j = 0; j < Dim; ++j) {
          const double* VP = traction_.data() + n * static_cast<std::size_t>(Dim * i + j);
          for (std::size_t p = begin; p < end; ++p) total += VP[p] * weights.dN(j, a, p);
        }
        force[Dim * a + i] = total;
      }
    }
  }

  CornerSum corner_sum_;
  std::vector<std::size_t> block_begin_;  // first occupied cell of each block, and the number of cells at the end
  std::vector<double> corner_;            // (cells × corners) [N]
  std::vector<double> traction_;          // V_p P_ij, (tensor × P) [J]
};

}  // namespace stillpoint
