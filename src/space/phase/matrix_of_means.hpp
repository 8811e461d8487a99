// The tangent stiffness of points that share their change of volume.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "space/kernels/cell_assembly.hpp"
#include "space/kernels/cell_order.hpp"
#include "space/kernels/gather_scatter_bilinear.hpp"
#include "space/kernels/mean_dilatation.hpp"
#include "space/materials/moduli_of.hpp"
#include "space/phase/matrix_with_means.hpp"
#include "space/phase/phase_frame.hpp"
#include "space/phase/phase_trial.hpp"
#include "space/phase/point_laws.hpp"

namespace stillpoint {

/// The matrices of a cell with a spline basis for the means: the derivatives of forces at its functions and of shares
/// at its splines by displacements of the former and means of the latter.
template <int Unknowns, int Splines>
struct MixedCellMatrix {
  template <int Rows, int Columns>
  using Matrix = std::array<std::array<double, static_cast<std::size_t>(Columns)>, static_cast<std::size_t>(Rows)>;

  Matrix<Unknowns, Splines> force_of_mean{};
  Matrix<Splines, Unknowns> share_of_u{}, mean_of_u{};
  Matrix<Splines, Splines> share_of_mean{};
};

/// A SplinePass for a unit derivative: takes the given rates of means of the block's points, and returns those of
/// shares.
template <AxisBasis B, Kinematics K>
struct UnitPass : SplinePass<B, K> {
  using Row = typename PointBlock<K>::Row;
  Row* rates_of_mean;
  Row* rates_of_share;

  UnitPass(const SplinePass<B, K>& pass, Row& of_mean, Row& of_share)
      : SplinePass<B, K>(pass), rates_of_mean(&of_mean), rates_of_share(&of_share) {}
  void rates_of_means(const PointBlock<K>&, const Row&, Row& mean) const { mean = *rates_of_mean; }
  void rates_of_shares(const PointBlock<K>&, const Row& y, Row& share) const {
    *rates_of_share = y;
    share.fill(0);
  }
};

/// Assembles the matrix column by column, as the points of a cell are coupled.
template <AxisBasis B, Kinematics K>
class MatrixOfMeans {
  static constexpr int dim = dimensions(K), per_cell = PointWeights<B, K>::per_cell;
  static constexpr int components = stillpoint::gradient_components(K);
  static constexpr int unknowns = dim * per_cell;
  using Block = PointBlock<K>;
  using Matrix = CellMatrix<dim, per_cell>;
  using Laws = PointLaws<B, K>;
  using Work = typename Laws::Work;

 public:
  /// u: over the grid's functions; dt: since the last commit. All arguments must outlive this object.
  MatrixOfMeans(Tangent kind, double dt, const double* u, const PhaseFrame<B, K>& frame, const Laws& laws,
                const CommittedState& committed, Work& work)
      : kind_(kind),
        dt_(dt),
        u_(u),
        frame_(frame),
        points_(frame.body.points),
        laws_(laws),
        committed_(committed),
        work_(work) {}

  SparseMatrix over_cells() {
    const auto add_cell = [&](std::size_t k, Matrix& matrix) {
      for_parts_of_cell(k, [&] {
        MeanOverCells<K> mean({points_, laws_.volume_share().data() + block_.first}, laws_.is_finite(material(k)));
        const auto direct = [&](int column) { take_unit(k, column / dim, column % dim); };
        const auto take = [&](int column, const auto& force) {
          for (int row = 0; row < unknowns; ++row) matrix[row][column] += force[row];
        };
        answer_columns(k, mean, unknowns, direct, take);
      });
    };
    return assembled(add_cell);
  }

  /// By matrix_with_means().
  SparseMatrix over_splines() {
    constexpr int per_cell_of_means = SplineMeans<B, K>::per_cell;
    laws_.take_means(u_, work_);
    laws_.take_shares(u_, dt_, work_);
    const SplineMeans<B, K>& splines = laws_.splines();
    const SplinePass<B, K> pass(splines, laws_.volumes(), {.means = &work_.means, .shares = &work_.shares}, nullptr);
    const DegreesOfFreedom& dofs = frame_.dofs();
    const Ranks* const ranks = frame_.ranks;
    Entries force_of_mean(ranks), share_of_u(ranks), mean_of_u(ranks), share_of_mean(ranks);
    const auto add_cell = [&](std::size_t k, Matrix& matrix) {
      const CellPlace place = place_of_cell(points_, k);
      MixedCellMatrix<unknowns, per_cell_of_means> mixed;
      for_parts_of_cell(k, [&] { add_part(k, pass, matrix, mixed); });
      for (int u = 0; u < unknowns; ++u) {
        dofs.for_sources(dim * frame_.weights.function(k, u / dim) + u % dim, [&](int, int dof, double weight) {
          if (!dofs.is_free(dof)) return;
          for (int a = 0; a < per_cell_of_means; ++a) {
            const int A = splines.function(k, a);
            force_of_mean.add(place, dof, A, weight * mixed.force_of_mean[u][a]);
            share_of_u.add(place, A, dof, weight * mixed.share_of_u[a][u]);
            mean_of_u.add(place, A, dof, weight * mixed.mean_of_u[a][u]);
          }
        });
      }
      for (int a = 0; a < per_cell_of_means; ++a) {
        for (int b = 0; b < per_cell_of_means; ++b)
          share_of_mean.add(place, splines.function(k, a), splines.function(k, b), mixed.share_of_mean[a][b]);
      }
    };
    const SparseMatrix K_uu = assembled(add_cell);
    return matrix_with_means(K_uu, splines.matrix(),
                             {force_of_mean.of_all(), share_of_u.of_all(), mean_of_u.of_all(), share_of_mean.of_all()});
  }

 private:
  // Entries of a matrix, cell by cell.
  class Entries {
   public:
    explicit Entries(const Ranks* ranks) : ranks_(ranks) {}
    void add(const CellPlace& place, int row, int column, double value) {
      if (ranks_) places_.push_back(place);
      entries_.emplace_back(row, column, value);
    }
    /// Those of all ranks.
    MatrixEntries of_all() { return in_cell_order(ranks_, places_, std::move(entries_)); }

   private:
    const Ranks* ranks_;
    std::vector<CellPlace> places_;
    MatrixEntries entries_;
  };

  template <class AddCell>
  SparseMatrix assembled(const AddCell& add_cell) const {
    return assemble_whole_cells<B, K>(frame_.grid, points_, frame_.weights, frame_.corner_sum, frame_.dofs(), add_cell)
        .free;
  }
  std::size_t material(std::size_t k) const { return static_cast<std::size_t>(points_.material_of_cell(k)); }

  // Adds the points in the block, of cell k, to the matrices of a cell with a spline basis for the means.
  template <class Mixed>
  void add_part(std::size_t k, const SplinePass<B, K>& pass, Matrix& matrix, Mixed& mixed) {
    constexpr int per_cell_of_means = SplineMeans<B, K>::per_cell;
    const bool finite = laws_.is_finite(material(k));
    typename Block::Row of_mean{}, of_share{};
    std::vector<TensorOf<K>> f(block_.count);  // f of the points themselves
    for (std::size_t q = 0; q < block_.count; ++q) f[q] = ChangeOfVolume<K>::deformation(block_, finite, q);
    std::vector<typename SplineMeans<B, K>::OfCell> N(block_.count);
    for (std::size_t q = 0; q < block_.count; ++q) N[q] = laws_.splines().N(block_.first + q);
    const auto direct = [&](int column) {
      if (column < unknowns) {
        take_unit(k, column / dim, column % dim);
        std::fill_n(of_mean.begin(), block_.count, 0.0);
        for (std::size_t q = 0; q < block_.count; ++q) {
          const double dJ = ChangeOfVolume<K>::rate_at(block_, f[q], q);
          for (int a = 0; a < per_cell_of_means; ++a)
            mixed.mean_of_u[a][column] += points_.volume[block_.first + q] * N[q][a] * dJ;
        }
      } else {
        for (auto& row : block_.direction) std::fill_n(row.begin(), block_.count, 0.0);
        for (std::size_t q = 0; q < block_.count; ++q) of_mean[q] = N[q][column - unknowns];
      }
    };
    const auto take = [&](int column, const auto& force) {
      const bool of_u = column < unknowns;
      for (int row = 0; row < unknowns; ++row) {
        double& entry = of_u ? matrix[row][column] : mixed.force_of_mean[row][column - unknowns];
        entry += force[row];
      }
      for (int a = 0; a < per_cell_of_means; ++a) {
        double& entry = of_u ? mixed.share_of_u[a][column] : mixed.share_of_mean[a][column - unknowns];
        for (std::size_t q = 0; q < block_.count; ++q) entry += N[q][a] * of_share[q];
      }
    };
    MeanDilatation<K, UnitPass<B, K>> mean({pass, of_mean, of_share}, finite);
    answer_columns(k, mean, unknowns + per_cell_of_means, direct, take);
  }

  // Calls visit() with the block's points, H and dH of cell k gathered, once except for a cell with more points than a
  // block.
  template <class Visit>
  void for_parts_of_cell(std::size_t k, const Visit& visit) {
    block_.first_cell = k;
    block_.last_cell = k + 1;
    for (block_.first = points_.begin(k); block_.first < points_.end(k); block_.first += block_.count) {
      block_.count = std::min(Block::size, points_.end(k) - block_.first);
      GatherScatter<B, K>::template gather<true>(frame_.weights, k, block_.first, block_.first + block_.count, u_,
                                                 committed_.u.data(), block_.first, block_.H, block_.dH);
      visit();
    }
  }
  // Sets the block's direction to that of a unit of component i of cell k's local function b.
  void take_unit(std::size_t k, int b, int i) {
    for (auto& row : block_.direction) std::fill_n(row.begin(), block_.count, 0.0);
    for (std::size_t q = 0; q < block_.count; ++q) {
      const auto dN = frame_.weights.dN(k, block_.first + q);
      for (int j = 0; j < dim; ++j) block_.direction[dim * i + j][q] = dN[per_cell * j + b];
      if constexpr (K == Kinematics::axisymmetric)
        if (i == 0) block_.direction[dim * dim][q] = dN[per_cell * dim + b];
    }
  }
  // Calls take(column, forces at the cell's functions) for columns 0 … columns − 1; direct(column) sets the block's
  // direction.
  template <class Mean, class Direct, class Take>
  void answer_columns(std::size_t k, Mean& mean, int columns, const Direct& direct, const Take& take) {
    const std::size_t m = material(k);
    const PointMaterial<K>& law = laws_.law(m);
    const double* V = laws_.volumes() + block_.first;
    mean.average(block_, committed_.averages.data() + block_.first, nullptr);
    law.stress(block_, laws_.volumes(), dt_, laws_.unread_history(m, work_));
    mean.keep_stress(block_);
    std::vector<typename PointMaterial<K>::ModuliMatrix> A(block_.count);
    for (std::size_t q = 0; q < block_.count; ++q)
      A[q] = moduli_of(law, kind_, block_.H_at(q), block_.dH_at(q), dt_, block_.first + q);
    for (int column = 0; column < columns; ++column) {
      direct(column);
      mean.average_direction(block_);
      // V A : δH̄
      for (std::size_t q = 0; q < block_.count; ++q) {
        for (int c = 0; c < components; ++c) {
          double dP = 0;
          for (int e = 0; e < components; ++e) dP += A[q][components * c + e] * block_.direction[e][q];
          block_.VP[c][q] = V[q] * dP;
        }
      }
      mean.transform_tangent(block_);
      std::array<double, static_cast<std::size_t>(unknowns)> force;
      GatherScatter<B, K>::scatter(frame_.weights, k, block_.first, block_.first + block_.count, block_, force.data());
      take(column, force);
    }
  }

  const Tangent kind_;
  const double dt_;
  const double* u_;
  const PhaseFrame<B, K>& frame_;
  const MaterialPoints<dim>& points_;
  const Laws& laws_;
  const CommittedState& committed_;
  Work& work_;
  Block block_;
};

}  // namespace stillpoint
