// One cycle of multigrid on a symmetric positive definite K: an approximation of K⁻¹, symmetric and positive definite
// itself, whose cost and quality do not change with the number of unknowns.
//
// By smoothed aggregation, with the rigid motions for what coarser levels must not lose [Vaněk, Mandel and Brezina
// 1996], of PETSc (GAMG). PETSc and the MPI under it take a tenth of a second to start: they are loaded when the first
// cycle is made, from a module of their own.
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
  /// x = B b, B ≈ K⁻¹; b, x: (n), may be the same array. By one thread at a time: others wait.
  virtual void apply(ConstVec b, Vec x) const = 0;
  virtual int levels() const = 0;
  /// What the hierarchy takes, K's own copy included [bytes].
  virtual std::size_t bytes() const = 0;
};

/// Whether there is a module to load, or why not, with the package to install; empty: there is one.
std::string multigrid_is_missing();

/// K: (n × n), symmetric positive definite. Throws std::runtime_error if there is no module, or if PETSc fails.
std::unique_ptr<Multigrid> make_multigrid(const SparseMatrix& K, const NodalLayout& layout);

}  // namespace stillpoint
