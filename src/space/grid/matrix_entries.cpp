#include "space/grid/matrix_entries.hpp"

namespace stillpoint {

SplitMatrix over_free_unknowns(const MatrixEntries& of_all, const DegreesOfFreedom& dofs) {
  MatrixEntries of_free, of_prescribed;
  const auto n = static_cast<int>(dofs.size());
  for (std::size_t unknown = 0; unknown < dofs.number.size(); ++unknown) {
    const int column = dofs.number[unknown];
    if (column < 0) continue;
    dofs.for_sources(static_cast<int>(unknown), [&](int, int dof, double weight) {
      if (dof < n) {
        of_free.emplace_back(column, dof, weight);
      } else {
        of_prescribed.emplace_back(column, dof - n, weight);
      }
    });
  }
  const auto matrix = [&](const MatrixEntries& entries, std::size_t columns) {
    Eigen::SparseMatrix<double> made(static_cast<Eigen::Index>(dofs.with_all_others()),
                                     static_cast<Eigen::Index>(columns));
    made.setFromTriplets(entries.begin(), entries.end());
    return made;
  };
  const Eigen::SparseMatrix<double> A = matrix(of_all, dofs.with_all_others());
  const Eigen::SparseMatrix<double> E_f = matrix(of_free, dofs.size());
  const Eigen::SparseMatrix<double> E_p = matrix(of_prescribed, dofs.prescribed.size());
  const Eigen::SparseMatrix<double> A_E_f = A * E_f, A_E_p = A * E_p;
  return {E_f.transpose() * A_E_f, E_f.transpose() * A_E_p};
}

}  // namespace stillpoint
