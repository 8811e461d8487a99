// One cycle of multigrid on a symmetric positive definite K: an approximation of K⁻¹, symmetric and positive definite
// itself, whose cost and quality do not change with the number of unknowns.
//
// The hierarchy is by smoothed aggregation, with the rigid motions as the modes that coarser levels have to preserve
// [Vaněk, Mandel and Brezina 1996], of PETSc (GAMG). PETSc and the MPI under it take a tenth of a second to start: they
// are loaded when the first cycle is made, from a module of their own.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <memory>
#include <string>

#include "linalg/nodal_layout.hpp"

namespace stillpoint {

class Multigrid {
 public:
  virtual ~Multigrid() = default;
  /// x = B b, B ≈ K⁻¹; b, x: (n), may be the same array. One thread at a time works on it: others wait.
  virtual void apply(ConstVec b, Vec x) const = 0;
  virtual int levels() const = 0;
  /// The memory of the hierarchy, with its copy of K [bytes].
  virtual std::size_t bytes() const = 0;
};

/// Why there is no module to load, with the package to install; empty if there is one.
std::string multigrid_is_missing();

/// K: (n × n), symmetric positive definite. Throws std::runtime_error if there is no module, or if PETSc fails.
std::unique_ptr<Multigrid> make_multigrid(const SparseMatrix& K, const NodalLayout& layout);

/// The cycle of one stiffness carried over to another one that shares most of its unknowns: that of the next phase, in
/// which some nodes are new and some gone. B: a cycle on the unknowns in `from`. K: the stiffness on those in `to`,
/// with a positive diagonal. Nodes at the same place, to the bit, are the same.
///   B' = P B Pᵀ + D⁻¹     P: from the old unknowns to the new ones at the same place; D: diagonal of K in new unknowns
/// is symmetric and positive definite as B is.
std::shared_ptr<const Multigrid> carry(std::shared_ptr<const Multigrid> B, const NodalLayout& from,
                                       const NodalLayout& to, const SparseMatrix& K);

}  // namespace stillpoint
