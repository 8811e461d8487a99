// Matrices over the unknowns of a grid from their entries.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "space/grid/degrees_of_freedom.hpp"

namespace stillpoint {

/// Entries of a matrix over degrees of freedom; those of equal row and column are summed.
using MatrixEntries = std::vector<Eigen::Triplet<double>>;

/// A matrix over all degrees of freedom, restricted to rows of the free ones.
struct SplitMatrix {
  Eigen::SparseMatrix<double> free;        // (n × n)
  Eigen::SparseMatrix<double> prescribed;  // (n × supports): how supports act on free degrees of freedom
};

/// The matrices E_fᵀ A E_f and E_fᵀ A E_p of A = of_all over all degrees of freedom, where u = E_f u_f + E_p u_p gives
/// all unknowns, extended ones included, by the free and prescribed ones.
SplitMatrix over_free_unknowns(const MatrixEntries& of_all, const DegreesOfFreedom& dofs);

}  // namespace stillpoint
