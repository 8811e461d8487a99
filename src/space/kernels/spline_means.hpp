// Means over splines of one degree less than the basis, on the same grid: the Means of MeanDilatation in which the
// points of neighbouring cells share too.
//
//   x̄_p = Σ_A N_pA c_A,   c = G Σ_q N_q V_q x_q,   m_A = Σ_p V_p N_pA,   M_AB = Σ_p V_p N_pA N_pB.
//
// With G = m⁻¹ this is S, the averaging of values at functions and back, whose error is of second order in the cell
// size. T = I − (I − S)^p adds the means of the remainder that S leaves, up to p times for a basis of degree p:
//
//   G = Σ_j (I − m⁻¹ M)^j m⁻¹,   j = 0 … p − 1,
//
// so that the error is of order 2 p, above the p + 1 of the displacement. T reproduces constants, and is self-adjoint
// in Σ V x y with eigenvalues from 0 to 1, as a projection is; but it needs no system to be solved, and reaches p
// cells. Its rank is the number of splines, about one a cell: as many constraints as there are means over cells, which
// for smooth bases is half the number of unknowns. (A projection onto polynomials of that degree in each cell by
// itself, with three or six constraints a cell, locks as if nothing were averaged.)
//
// Points of different materials have separate means.
#pragma once

#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <Eigen/SparseCore>

#include "base/lanes.hpp"
#include "base/memory_report.hpp"
#include "base/parallel_loop.hpp"
#include "space/grid/basis.hpp"
#include "space/grid/domain_basis.hpp"
#include "space/kernels/cell_order.hpp"
#include "space/kernels/corner_sum.hpp"
#include "space/materials/point_material.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class SplineMeans {
  static constexpr int dim = dimensions(K);
  static constexpr int degree = std::max(1, B::degree - 1);
  using Spline = std::conditional_t<B::window == 1, BSpline<degree>, DomainBSpline<degree>>;
  using Basis = TensorBasis<Spline, dim>;
  // The functions of a cell are stored in rows along the first axis.
  static constexpr int along = Spline::per_cell, rows = Basis::per_cell / along, lanes = along <= 2 ? 2 : 4;
  static constexpr int weights_of_point = lanes + along * (dim - 1);
  using Block = PointBlock<K>;
  using Row = typename Block::Row;

 public:
  static constexpr int per_cell = Basis::per_cell;
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using OfCell = std::array<double, static_cast<std::size_t>(per_cell)>;

  /// The arrays in which an evaluation sums over the points.
  struct Sums {
    std::vector<double> corner;       // over each cell's points, of one quantity, (cells × per_cell)
    std::vector<double> first, next;  // (functions)
  };

  /// Prepares for the points of a phase, which must outlive this object or the next rebuild(). ranks: that share them.
  void rebuild(const Grid<dim>& grid, const MaterialPoints<dim>& points, const Ranks* ranks) {
    points_ = &points;
    evaluate(grid);
    const std::vector<CellPlace> places = places_of_cells(points), all = in_cell_order(ranks, places, places);
    const std::vector<int> of_all = numbered_functions(grid, all);
    function_ = own_functions(places, all, of_all);
    corner_sum_.rebuild(function_, count_, ranks, places);
    weigh(of_all, in_cell_order(ranks, places, weights_of_cells()));
  }
  /// Gives the sums of an evaluation their sizes in the present phase.
  void resize(Sums& sums) const {
    sums.corner.resize(corner_sum_.corners() + CornerSum::slack);
    for (auto* of_functions : {&sums.first, &sums.next}) of_functions->resize(functions());
  }

  /// The number of functions that reach a point, over all materials.
  std::size_t functions() const { return count_; }
  /// Number of local function a in occupied cell k.
  int function(std::size_t k, int a) const { return function_[per_cell * k + static_cast<std::size_t>(a)]; }
  /// The matrix G.
  Matrix matrix() const {
    const auto n = static_cast<Eigen::Index>(functions());
    Matrix first(n, n);
    first.setIdentity();
    first = Eigen::Map<const Eigen::VectorXd>(inverse_m_.data(), n).asDiagonal() * first;
    Matrix G = first;
    for (int j = 1; j < terms; ++j) G = first + Matrix(missed_ * G);
    return G;
  }

  /// The values N_pA of the functions of the point's cell.
  OfCell N(std::size_t p) const {
    OfCell N;
    for (int a = 0; a < per_cell; ++a)
      N[static_cast<std::size_t>(a)] = weight_[weights_of_point * p + a % along] * row_weight(p, a / along);
    return N;
  }
  /// Sets the means x̄ of the block's points.
  void values(const Block& block, const std::vector<double>& c, Row& x) const {
    for_cells(
        block, [&](std::size_t k, std::size_t begin, std::size_t end) __attribute__((always_inline)) {
          std::array<double, static_cast<std::size_t>(lanes * rows)> of_cell{};
          unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
            of_cell[lanes * (a / along) + a % along] = c[static_cast<std::size_t>(function(k, a))];
          });
          for (std::size_t p = begin; p < end; ++p) {
            auto sum = Lanes<lanes>::load(of_cell.data()).times(row_weight(p, 0));
            unroll<rows - 1>([&](auto r) __attribute__((always_inline)) {
              sum.add(row_weight(p, r + 1), Lanes<lanes>::load(of_cell.data() + lanes * (r + 1)));
            });
            sum = sum.times(along_row(p));
            x[p - block.first] = sum[0] + sum[1] + (along > 2 ? sum[lanes - 2] + sum[lanes - 1] : 0);
          }
        });
  }
  /// Adds y_p of the block's points to Σ_p N_p y_p; blocks of different cells may do so in parallel.
  void add(const Block& block, const Row& y, Sums& sums) const {
    for_cells(
        block, [&](std::size_t k, std::size_t begin, std::size_t end) __attribute__((always_inline)) {
          std::array<Lanes<lanes>, static_cast<std::size_t>(rows)> of_cell{};
          for (std::size_t p = begin; p < end; ++p) {
            const auto weighted = along_row(p).times(y[p - block.first]);
            unroll<rows>([&](auto r) __attribute__((always_inline)) { of_cell[r].add(row_weight(p, r), weighted); });
          }
          double* corner = sums.corner.data() + per_cell * k;
          const bool begins = begin == points_->begin(k);  // what stands there is of an earlier sum
          unroll<per_cell>([&](auto a) __attribute__((always_inline)) {
            corner[a] = (begins ? 0 : corner[a]) + of_cell[a / along][a % along];
          });
        });
  }
  /// The coefficients c = G Σ_p N_p y_p of the sum over all blocks, (functions): c = m⁻¹ b, then p − 1 times c = m⁻¹ b
  /// + (I − m⁻¹ M) c.
  void coefficients(Sums& sums, std::vector<double>& c) const {
    std::vector<double>&first = sums.first, &next = sums.next;
    corner_sum_.for_functions(sums.corner.data(), 1, [&](std::size_t A) {
      first[A] = inverse_m_[A] * corner_sum_.sum<1>(A, sums.corner.data())[0];
    });
    corner_sum_.complete(first.data(), 1);
    c = first;
    for (int j = 1; j < terms; ++j) {
      for_each_block(functions(), [&](std::size_t A) {
        double of_row = first[A];
        for (typename Matrix::InnerIterator entry(missed_, static_cast<Eigen::Index>(A)); entry; ++entry)
          of_row += entry.value() * c[static_cast<std::size_t>(entry.col())];
        next[A] = of_row;
      });
      c.swap(next);
    }
  }

  /// The arrays that are stored for each point.
  static std::vector<PointArray> arrays() {
    return {{"weights of means", weights_of_point * static_cast<double>(sizeof(double))}};
  }

 private:
  static constexpr int terms = B::degree;  // number of terms of G

  [[gnu::always_inline]] Lanes<lanes> along_row(std::size_t p) const {
    return Lanes<lanes>::load(weight_.data() + weights_of_point * p);
  }
  [[gnu::always_inline]] double row_weight(std::size_t p, int row) const {
    double weight = 1;
    for (int d = 1; d < dim; ++d) {
      weight *= weight_[weights_of_point * p + static_cast<std::size_t>(lanes + along * (d - 1) + row % along)];
      row /= along;
    }
    return weight;
  }

  // Computes the factors of N along each axis, those of the first axis padded with zeros.
  void evaluate(const Grid<dim>& grid) {
    weight_.assign(weights_of_point * points_->size(), 0);
    for_each_block(points_->cells(), [&](std::size_t k) {
      const auto cell = grid.cell_at(points_->cell[k]);
      std::array<double, along> slope;
      for (std::size_t p = points_->begin(k); p < points_->end(k); ++p) {
        double* of_point = weight_.data() + weights_of_point * p;
        for (std::size_t d = 0; d < dim; ++d) {
          Spline::evaluate(grid.axes[d], cell[d], points_->x[d][p], of_point, slope.data());
          of_point += d == 0 ? lanes : along;
        }
      }
    });
  }
  // The functions of these cells, (cells × per_cell), in the order in which cells come to them. Sets their number.
  std::vector<int> numbered_functions(const Grid<dim>& grid, const std::vector<CellPlace>& cells) {
    const auto offset = Basis::offsets(grid);
    const auto of_grid = static_cast<std::size_t>(Basis::count(grid));
    std::vector<int> number(of_grid * points_->materials(), -1), functions(per_cell * cells.size());
    int next = 0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::size_t first = of_grid * static_cast<std::size_t>(cells[k].material) +
                                static_cast<std::size_t>(Basis::first(grid, grid.cell_at(cells[k].cell)));
      for (std::size_t a = 0; a < per_cell; ++a) {
        int& known = number[first + static_cast<std::size_t>(offset[a])];
        if (known < 0) known = next++;
        functions[per_cell * k + a] = known;
      }
    }
    count_ = static_cast<std::size_t>(next);
    return functions;
  }
  // Those of the cells of this rank among all.
  static std::vector<int> own_functions(const std::vector<CellPlace>& own, const std::vector<CellPlace>& all,
                                        const std::vector<int>& of_all) {
    if (own.size() == all.size()) return of_all;
    std::vector<int> functions;
    functions.reserve(per_cell * own.size());
    for (const CellPlace& place : own) {
      const auto first = of_all.begin() + per_cell * (std::ranges::lower_bound(all, place) - all.begin());
      functions.insert(functions.end(), first, first + per_cell);
    }
    return functions;
  }
  // The sums over the points of a cell, Σ V_p N_pA and Σ V_p N_pA N_pB.
  struct WeightsOfCell {
    OfCell m{};
    std::array<OfCell, static_cast<std::size_t>(per_cell)> M{};
  };
  std::vector<WeightsOfCell> weights_of_cells() const {
    std::vector<WeightsOfCell> cells(points_->cells());
    for_each_block(cells.size(), [&](std::size_t k) {
      for (std::size_t p = points_->begin(k); p < points_->end(k); ++p) {
        const OfCell weight = N(p);
        for (std::size_t a = 0; a < per_cell; ++a) {
          cells[k].m[a] += points_->volume[p] * weight[a];
          for (std::size_t b = 0; b < per_cell; ++b) cells[k].M[a][b] += points_->volume[p] * weight[a] * weight[b];
        }
      }
    });
    return cells;
  }
  // Computes m⁻¹ and I − m⁻¹ M from all cells, whose functions these are. Functions that no point reaches have no mean,
  // and none is needed.
  void weigh(const std::vector<int>& functions_of_cells, const std::vector<WeightsOfCell>& cells) {
    inverse_m_.assign(functions(), 0);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(per_cell * per_cell * cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const int* const of_cell = functions_of_cells.data() + per_cell * k;
      for (std::size_t a = 0; a < per_cell; ++a) {
        inverse_m_[static_cast<std::size_t>(of_cell[a])] += cells[k].m[a];
        for (std::size_t b = 0; b < per_cell; ++b) entries.emplace_back(of_cell[a], of_cell[b], cells[k].M[a][b]);
      }
    }
    for (double& of_function : inverse_m_) of_function = of_function > 0 ? 1 / of_function : 0;
    const auto n = static_cast<Eigen::Index>(functions());
    Matrix M(n, n), one(n, n);
    M.setFromTriplets(entries.begin(), entries.end());
    one.setIdentity();
    missed_ = one - Matrix(Eigen::Map<const Eigen::VectorXd>(inverse_m_.data(), n).asDiagonal() * M);
  }

  /// Calls visit(occupied cell, first point, one past the last) for the cells of the block.
  template <class Visit>
  [[gnu::always_inline]] void for_cells(const Block& block, const Visit& visit) const {
    for (std::size_t k = block.first_cell; k < block.last_cell; ++k)
      visit(k, std::max(points_->begin(k), block.first), std::min(points_->end(k), block.first + block.count));
  }

  const MaterialPoints<dim>* points_ = nullptr;
  std::vector<double> weight_;  // (P × weights_of_point)
  std::size_t count_ = 0;       // number of functions
  std::vector<int> function_;   // (cells × per_cell)
  CornerSum corner_sum_;
  std::vector<double> inverse_m_;  // (functions) [1/m³]
  Matrix missed_;                  // I − m⁻¹ M, (functions × functions)
};

/// The Means of MeanDilatation in one pass over the points.
template <AxisBasis B, Kinematics K>
class SplinePass {
  using Block = PointBlock<K>;
  using Row = typename Block::Row;
  using Coefficients = const std::vector<double>*;

 public:
  /// The coefficients of the state's means and shares, and of the means' derivative. Where those of the shares are
  /// null, the shares are summed, as those of a derivative always are: their coefficients are known after all blocks,
  /// and then go to write_shares().
  struct Known {
    Coefficients means = nullptr, shares = nullptr, rates_of_means = nullptr;
  };

  using Sums = typename SplineMeans<B, K>::Sums;

  /// sums: where the shares are summed; null in a pass that sums none.
  SplinePass(const SplineMeans<B, K>& splines, const double* V, const Known& known, Sums* sums)
      : splines_(&splines), V_(V), known_(known), sums_(sums) {}

  void means(const Block& block, const Row&, Row& mean) const { splines_->values(block, *known_.means, mean); }
  void rates_of_means(const Block& block, const Row&, Row& mean) const {
    splines_->values(block, *known_.rates_of_means, mean);
  }
  void shares(const Block& block, const Row& y, Row& share) const {
    if (!known_.shares) return rates_of_shares(block, y, share);
    write_shares(block, *known_.shares, share);
  }
  void rates_of_shares(const Block& block, const Row& y, Row& share) const {
    splines_->add(block, y, *sums_);
    share.fill(0);
  }
  /// The shares Σ_q T_qp y_q = V_p Σ_A N_pA c_A.
  void write_shares(const Block& block, const std::vector<double>& c, Row& share) const {
    splines_->values(block, c, share);
    for (std::size_t q = 0; q < block.count; ++q) share[q] *= V_[block.first + q];
  }

 private:
  const SplineMeans<B, K>* splines_;
  const double* V_;
  Known known_;
  Sums* sums_;
};

}  // namespace stillpoint
