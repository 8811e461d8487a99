#include "space/points/local_fit.hpp"

#include <cmath>

#include <Eigen/QR>

namespace stillpoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The monomials of ξ up to a total degree, one in each column, the constant first; one row for each point.
MatrixXd monomials(const std::vector<double>& xi, std::size_t dim, int degree) {
  const auto n = static_cast<Index>(xi.size() / dim);
  std::vector<VectorXd> columns = {VectorXd::Ones(n)};
  // The monomials of the next degree: each of the last degree, times a coordinate that is not before its own last one.
  std::vector<std::size_t> last = {0};
  std::size_t begin = 0;
  for (int d = 1; d <= degree; ++d) {
    const std::size_t end = columns.size();
    for (std::size_t m = begin; m < end; ++m) {
      for (std::size_t axis = last[m]; axis < dim; ++axis) {
        VectorXd column = columns[m];
        for (Index p = 0; p < n; ++p) column[p] *= xi[dim * static_cast<std::size_t>(p) + axis];
        columns.push_back(std::move(column));
        last.push_back(axis);
      }
    }
    begin = end;
  }
  MatrixXd all(n, static_cast<Index>(columns.size()));
  for (std::size_t m = 0; m < columns.size(); ++m) all.col(static_cast<Index>(m)) = columns[m];
  return all;
}

}  // namespace

std::vector<double> local_fit(const std::vector<double>& xi, const std::vector<double>& weight, std::size_t dim,
                              int degree) {
  constexpr double rounding = 1e-8, most = 10;
  const VectorXd root = Eigen::Map<const VectorXd>(weight.data(), static_cast<Index>(weight.size())).cwiseSqrt();
  for (;; --degree) {
    // With A = [monomials at ξ_p] and W^½ A P = Q R,
    //
    //   c = W A (Aᵀ W A)⁻¹ e_1 = W^½ Q R⁻ᵀ Pᵀ e_1.
    Eigen::ColPivHouseholderQR<MatrixXd> qr;
    qr.setThreshold(rounding);
    qr.compute(root.asDiagonal() * monomials(xi, dim, degree));
    const Index columns = qr.cols();
    if (qr.rank() < columns && degree > 0) continue;
    VectorXd c = VectorXd::Zero(root.size());
    c.head(columns) = qr.colsPermutation().transpose() * VectorXd::Unit(columns, 0);
    qr.matrixR()
        .topLeftCorner(columns, columns)
        .triangularView<Eigen::Upper>()
        .transpose()
        .solveInPlace(c.head(columns));
    c = root.cwiseProduct(qr.householderQ() * c);
    if (c.lpNorm<1>() <= most || degree == 0) return {c.begin(), c.end()};
  }
}

}  // namespace stillpoint
