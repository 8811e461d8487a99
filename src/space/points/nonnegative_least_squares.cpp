#include "space/points/nonnegative_least_squares.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/Householder>
#include <Eigen/Jacobi>

namespace stillpoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The least squares of some columns of E, which come and go one at a time: Qᵀ [columns] = [R; 0] with Q orthogonal. A
// column that comes is one more reflection, one that goes a few rotations, so that neither factorises the others again.
class GrowingLeastSquares {
 public:
  GrowingLeastSquares(const MatrixXd& E, const VectorXd& f)
      : E_(E), Q_(MatrixXd::Identity(E.rows(), E.rows())), R_(E.rows(), std::min(E.rows(), E.cols())), Qf_(f) {}

  const std::vector<Index>& columns() const { return columns_; }
  Index size() const { return static_cast<Index>(columns_.size()); }
  bool full() const { return size() == R_.cols(); }

  // Takes a column, unless it depends on the others or pulls its own unknown below zero.
  bool take(Index column) {
    const Index k = size(), left = E_.rows() - k;
    VectorXd seen = Q_.transpose() * E_.col(column);
    VectorXd essential(left - 1);
    double factor = 0, diagonal = 0;
    seen.tail(left).makeHouseholder(essential, factor, diagonal);
    if (!(std::abs(diagonal) > least_share * E_.col(column).norm())) return false;
    VectorXd turned = Qf_.tail(left);
    double work = 0;
    turned.applyHouseholderOnTheLeft(essential, factor, &work);
    if (!(turned(0) / diagonal > 0)) return false;
    Qf_.tail(left) = turned;
    VectorXd workspace(Q_.rows());
    Q_.rightCols(left).applyHouseholderOnTheRight(essential, factor, workspace.data());
    R_.col(k).head(k) = seen.head(k);
    R_(k, k) = diagonal;
    columns_.push_back(column);
    return true;
  }

  // Lets the j-th column go.
  void let_go(Index j) {
    const Index last = size() - 1;
    for (Index k = j; k < last; ++k) {
      R_.col(k).head(k + 2) = R_.col(k + 1).head(k + 2);
    }
    for (Index k = j; k < last; ++k) {
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(R_(k, k), R_(k + 1, k));
      R_.middleCols(k, last - k).applyOnTheLeft(k, k + 1, rotation.adjoint());
      Qf_.applyOnTheLeft(k, k + 1, rotation.adjoint());
      Q_.applyOnTheRight(k, k + 1, rotation);
    }
    columns_.erase(columns_.begin() + j);
  }

  VectorXd solution() const {
    const Index k = size();
    return R_.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(Qf_.head(k));
  }

  // f − E x for the solution x.
  VectorXd residual() const {
    const Index left = E_.rows() - size();
    return Q_.rightCols(left) * Qf_.tail(left);
  }

 private:
  static constexpr double least_share = 1e-12;  // of a column that the others do not span
  const MatrixXd& E_;
  MatrixXd Q_, R_;
  VectorXd Qf_;
  std::vector<Index> columns_;
};

// Takes the column along which the residual falls most steeply; false if it falls along none.
bool enter_steepest(const MatrixXd& E, double tolerance, GrowingLeastSquares& passive) {
  VectorXd gradient = E.transpose() * passive.residual();
  for (const Index j : passive.columns()) gradient(j) = 0;
  Index steepest = 0;
  while (gradient.maxCoeff(&steepest) > tolerance) {
    if (passive.take(steepest)) return true;
    gradient(steepest) = 0;
  }
  return false;
}

// Moves x to the solution on the passive columns, which loses those on whose way there x would become negative.
void step_to_solution(GrowingLeastSquares& passive, VectorXd& x) {
  const auto value = [&](Index j) -> double& { return x(passive.columns()[static_cast<std::size_t>(j)]); };
  while (passive.size() > 0) {
    const VectorXd s = passive.solution();
    double share = 1;  // the longest of the way that keeps x ≥ 0
    for (Index j = 0; j < passive.size(); ++j)
      if (s(j) <= 0) share = std::min(share, value(j) / (value(j) - s(j)));
    for (Index j = 0; j < passive.size(); ++j) value(j) += share * (s(j) - value(j));
    if (share >= 1) return;
    for (Index j = passive.size() - 1; j >= 0; --j) {
      if (value(j) > 1e-15) continue;
      value(j) = 0;
      passive.let_go(j);
    }
  }
}

}  // namespace

VectorXd solve_nnls(const MatrixXd& E, const VectorXd& f) {
  const double tolerance = 1e-13 * (1 + E.cwiseAbs().maxCoeff()) * (1 + f.cwiseAbs().maxCoeff());
  GrowingLeastSquares passive(E, f);  // the columns for which x > 0 is allowed
  VectorXd x = VectorXd::Zero(E.cols());
  for (Index outer = 0; outer < 3 * E.cols() && !passive.full() && enter_steepest(E, tolerance, passive); ++outer)
    step_to_solution(passive, x);
  return x;
}

}  // namespace stillpoint
