// A cycle of multigrid on the unknowns of one stiffness, for another that has most of them as well: those of the next
// phase, some nodes of which are new and some gone.
//
//   B' = P B Pᵀ + D⁻¹     P: from the old unknowns to the new ones at the same place, D: K' of new ones, its diagonal
//
// Symmetric and positive definite as B is.
#pragma once

#include <memory>

#include "linalg/multigrid.hpp"

namespace stillpoint {

/// B: of the unknowns in `from`. K: of those in `to`, with a positive diagonal. Nodes at the same place, to the bit,
/// are the same.
std::shared_ptr<const Multigrid> carry(std::shared_ptr<const Multigrid> B, const NodalLayout& from,
                                       const NodalLayout& to, const SparseMatrix& K);

}  // namespace stillpoint
