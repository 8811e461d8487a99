// Matrices over the unknowns of a grid from their entries.
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "space/grid/degrees_of_freedom.hpp"

namespace stillpoint {

/// Entries of a matrix over degrees of freedom; those of equal row and column are summed.
using MatrixEntries = std::vector<Eigen::Triplet<double>>;

/// A matrix over all degrees of freedom, split at the free ones.
struct SplitMatrix {
  Eigen::SparseMatrix<double> free;        // (n × n)
  Eigen::SparseMatrix<double> prescribed;  // (n × supports): how supports act on free degrees of freedom
};

/// of_all: A over all degrees of freedom. Over the free unknowns u = E_f u_f + E_p u_p of which those of extended
/// functions are made, E_fᵀ A E_f and E_fᵀ A E_p.
SplitMatrix over_free_unknowns(const MatrixEntries& of_all, const DegreesOfFreedom& dofs);

}  // namespace stillpoint
