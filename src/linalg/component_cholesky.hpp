// A Cholesky factor of many small systems, which are solved side by side.
#pragma once

#include <stillpoint/types.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "linalg/sparse_cholesky.hpp"

namespace stillpoint {

/// The factor A = L Lᵀ of a symmetric positive definite A of some unknowns of a larger system, which fall into
/// components: no entry of A couples one with another. A component of a few unknowns has a dense factor; what is
/// coupled more widely shares a sparse one.
class ComponentCholesky {
 public:
  /// entries: those of A, of both triangles and with the diagonal, by the unknowns' numbers in the larger system, of so
  /// many unknowns; entries of one place are summed.
  ComponentCholesky(std::span<const Eigen::Triplet<double>> entries, std::size_t unknowns);

  /// Whether the factorisation succeeded, which proves (up to rounding) that A is positive definite.
  bool positive_definite() const { return positive_definite_; }
  /// The numbers of the unknowns, component by component.
  std::span<const int> unknowns() const { return unknowns_; }
  /// x = A⁻¹ b; b, x: (unknowns().size()), in their order, may be the same array. Allocates nothing. Needs
  /// positive_definite().
  void solve(ConstVec b, Vec x) const;

 private:
  struct Component {
    std::size_t first, size, factor;  // its unknowns, and the first entry of its factor
  };

  std::vector<std::size_t> order_by_components(std::span<const Eigen::Triplet<double>> entries,
                                               const std::vector<int>& numbers, const std::vector<std::size_t>& place);
  bool factorise(const Component& component);

  std::vector<int> unknowns_;
  std::vector<Component> small_;
  std::vector<double> factors_;           // L of each small component by rows, with 1/L_ii in place of L_ii
  std::size_t wide_ = 0;                  // where the unknowns of all other components begin
  std::optional<SparseCholesky> sparse_;  // of those
  bool positive_definite_ = true;
};

}  // namespace stillpoint
