// The part of what pieces of a border bear that the grid's functions can tell: the least squares over the pieces s by
// their areas A, with the weights w_sa of the functions a there,
//
//   p_s ← Σ_a w_sa P_a,   P = arg min Σ_s A_s (Σ_a w_sa P_a − p_s)².
//
// A multiplier for each piece would drift, as no function can tell the pieces of a cell apart, and one for each cell
// goes to and fro from cell to cell, as the means over cells hardly tell the motions that do. What is in the functions'
// own space is felt, all of it [a mortar method with multipliers of the order of the displacement: Puso and Laursen
// 2004]. At the end of what touches a function may reach a sliver of it alone: its value would hardly be felt, and is
// left to those beside it. On two sides of a corner a function has a value for each: pressures jump there.
//
// Where a border is curved on the grid functions on either side of it have nearly one trace, which tells their
// difference by chance. Of the P that lie so near that is taken which changes least across the border, by
//
//   + ε Σ_s A_s (h Σ_a n·∇N_a P_a)²,   ε = 0.01,
//
// which leaves p as it is where it is linear along a straight border.
#pragma once

#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "space/boundary/border_piece.hpp"

namespace stillpoint {

class TraceFit {
 public:
  /// pieces: the numbers of those of the border that touch, in a phase.
  template <Kinematics K>
  TraceFit(std::span<const BorderPiece<K>> border, const std::vector<std::size_t>& pieces);

  /// borne: by the pieces that touch, (pieces × components), and so is what is returned.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& borne) const;

 private:
  Eigen::VectorXd area_;                 // (pieces) [m²]
  Eigen::SparseMatrix<double> weights_;  // w, (pieces × functions)
  Eigen::SparseMatrix<double> gram_;     // Σ A w wᵀ
};

}  // namespace stillpoint
