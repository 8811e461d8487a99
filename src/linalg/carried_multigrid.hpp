// A multigrid cycle on the unknowns of one stiffness, carried over to another stiffness that shares most of them: that
// of the next phase, in which some nodes are new and some gone.
//
//   B' = P B Pᵀ + D⁻¹     P: from the old unknowns to the new ones at the same place; D: diagonal of K' in new unknowns
//
// B' is symmetric and positive definite as B is.
#pragma once

#include <memory>

#include "linalg/multigrid.hpp"

namespace stillpoint {

/// B: a cycle on the unknowns in `from`. K: the stiffness on those in `to`, with a positive diagonal. Nodes at the same
/// place, to the bit, are the same.
std::shared_ptr<const Multigrid> carry(std::shared_ptr<const Multigrid> B, const NodalLayout& from,
                                       const NodalLayout& to, const SparseMatrix& K);

}  // namespace stillpoint
