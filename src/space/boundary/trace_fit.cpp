#include "space/boundary/trace_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>

namespace stillpoint {
namespace {

template <Kinematics K>
using Border = std::span<const BorderPiece<K>>;

/// The side of a body that a piece is on, by the one of these directions to which its normal is nearest. They lie
/// between the directions that faces of bodies have as a rule, lest rounding sorts the pieces of one face.
template <Kinematics K>
int side_of(const BorderPiece<K>& piece) {
  constexpr int dim = dimensions(K);
  static const Eigen::Matrix3d axes =
      (Eigen::AngleAxisd(0.31, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.17, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int d = 0; d < dim; ++d) normal[d] = piece.vector[static_cast<std::size_t>(d)];
  const Eigen::Vector3d along = axes * normal;
  Eigen::Index nearest = 0;
  along.cwiseAbs().maxCoeff(&nearest);
  return 2 * static_cast<int>(nearest) + (along[nearest] > 0 ? 1 : 0);
}

/// Calls visit(key, w, n·∇N) for the functions of a piece, with a key for each function on each side.
template <Kinematics K, class Visit>
void for_functions(const BorderPiece<K>& piece, const Visit& visit) {
  constexpr int sides = 6;
  const int side = side_of(piece);
  const auto n = piece.normal();
  for (const auto& a : piece.at.entries) {
    if (a.function < 0 || a.w == 0) continue;
    double slope = 0;
    for (std::size_t d = 0; d < n.size(); ++d) slope += n[d] * a.dN[d];
    visit(sides * static_cast<std::int64_t>(a.function) + side, a.w, slope);
  }
}

using OfFunctions = std::unordered_map<std::int64_t, double>;

/// Σ A w² over these pieces.
template <Kinematics K>
OfFunctions squares(Border<K> border, const std::vector<std::size_t>& pieces) {
  OfFunctions sums;
  for (const std::size_t s : pieces)
    for_functions(border[s], [&](std::int64_t key, double w, double) { sums[key] += border[s].size() * w * w; });
  return sums;
}

/// The share of the border that a function reaches which is in these pieces.
template <Kinematics K>
OfFunctions shares(Border<K> border, const std::vector<std::size_t>& pieces) {
  OfFunctions shares = squares<K>(border, pieces);
  std::vector<std::size_t> all(border.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const OfFunctions of_all = squares<K>(border, all);
  for (auto& [key, share] : shares) share /= of_all.at(key);
  return shares;
}

}  // namespace

template <Kinematics K>
TraceFit::TraceFit(std::span<const BorderPiece<K>> border, const std::vector<std::size_t>& pieces)
    : area_(static_cast<Eigen::Index>(pieces.size())) {
  constexpr double sliver = 0.2;  // of the largest share of the functions at a piece
  const OfFunctions share = shares<K>(border, pieces);
  std::unordered_map<std::int64_t, int> column;
  std::vector<Eigen::Triplet<double>> of_weights, of_slopes;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const BorderPiece<K>& piece = border[pieces[k]];
    const auto row = static_cast<int>(k);
    area_[row] = piece.size();
    double most = 0, sum = 0, slopes = 0, steepest = 0;
    for_functions(piece, [&](std::int64_t key, double, double) { most = std::max(most, share.at(key)); });
    const auto counts = [&](std::int64_t key) { return share.at(key) >= sliver * most; };
    for_functions(piece, [&](std::int64_t key, double w, double slope) {
      if (!counts(key)) return;
      sum += w;
      slopes += slope;
      steepest = std::max(steepest, std::abs(slope));
    });
    for_functions(piece, [&](std::int64_t key, double w, double slope) {
      if (!counts(key)) return;
      const int next = static_cast<int>(column.size()), at = column.try_emplace(key, next).first->second;
      of_weights.emplace_back(row, at, w / sum);
      if (steepest > 0) of_slopes.emplace_back(row, at, (slope - slopes * w / sum) / steepest);
    });
  }
  const auto matrix = [&](const std::vector<Eigen::Triplet<double>>& entries) {
    Eigen::SparseMatrix<double> of_pieces(area_.size(), static_cast<Eigen::Index>(column.size()));
    of_pieces.setFromTriplets(entries.begin(), entries.end());
    return of_pieces;
  };
  weights_ = matrix(of_weights);
  const Eigen::SparseMatrix<double> across = matrix(of_slopes);
  const auto squares_of = [&](const Eigen::SparseMatrix<double>& of_pieces) -> Eigen::SparseMatrix<double> {
    return of_pieces.transpose() * area_.asDiagonal() * of_pieces;
  };
  constexpr double epsilon = 0.01;
  gram_ = squares_of(weights_) + epsilon * squares_of(across);
}

// Functions that the pieces cannot tell apart leave the matrix singular, and the equations consistent: conjugate
// gradients end at one of their solutions, all of which have the same trace.
Eigen::MatrixXd TraceFit::operator()(const Eigen::MatrixXd& borne) const {
  constexpr double exact = 1e-12;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(gram_);
  solver.setTolerance(exact);
  const Eigen::MatrixXd right = weights_.transpose() * (area_.asDiagonal() * borne);
  return weights_ * Eigen::MatrixXd(solver.solve(right));
}

template TraceFit::TraceFit(std::span<const BorderPiece<Kinematics::line>>, const std::vector<std::size_t>&);
template TraceFit::TraceFit(std::span<const BorderPiece<Kinematics::plane>>, const std::vector<std::size_t>&);
template TraceFit::TraceFit(std::span<const BorderPiece<Kinematics::axisymmetric>>, const std::vector<std::size_t>&);
template TraceFit::TraceFit(std::span<const BorderPiece<Kinematics::space>>, const std::vector<std::size_t>&);

}  // namespace stillpoint
