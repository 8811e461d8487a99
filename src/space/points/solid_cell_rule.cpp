#include "space/points/solid_cell_rule.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "geometry/gauss_rule.hpp"
#include "space/points/cut_cell_rule.hpp"
#include "space/points/moment_fit.hpp"
#include "space/points/nonnegative_least_squares.hpp"

namespace stillpoint {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRoundingOfMoments = 1e-11;  // for moments of order one
constexpr double kNoShare = 1e-12;

/// The number of polynomials in space up to a total degree.
std::size_t count_of(int degree) { return static_cast<std::size_t>((degree + 1) * (degree + 2) * (degree + 3)) / 6; }

// Copies the positions, as Eigen sums memory that is not aligned in an order that depends on its address.
Eigen::Matrix3Xd columns(const std::vector<SpacePoint>& x) {
  return Eigen::Map<const Eigen::Matrix3Xd>(x.front().data(), 3, static_cast<Index>(x.size()));
}
VectorXd vector_of_values(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}
VectorXd equal(std::size_t n) { return VectorXd::Constant(static_cast<Index>(n), 1.0 / static_cast<double>(n)); }

std::vector<SpacePoint> every_nth(const std::vector<SpacePoint>& x, std::size_t n) {
  std::vector<SpacePoint> some;
  for (std::size_t k = n / 2; k < x.size(); k += n) some.push_back(x[k]);
  return some;
}

// solve_nnls(A, b) with the rows of A made orthonormal first, A = Rᵀ Qᵀ: where they nearly depend on each other, as
// products of high degrees do in a part that is no box, it would end before its residual is small.
VectorXd solve_in_orthonormal_rows(const MatrixXd& A, const VectorXd& b) {
  if (A.cols() < A.rows()) return solve_nnls(A, b);
  const Eigen::HouseholderQR<MatrixXd> qr(A.transpose());
  const Eigen::ArrayXd diagonal = qr.matrixQR().diagonal().array().abs();
  if (!(diagonal.minCoeff() > 1e-10 * diagonal.maxCoeff())) return solve_nnls(A, b);
  const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(A.cols(), A.rows());
  const VectorXd f = qr.matrixQR().topRows(A.rows()).triangularView<Eigen::Upper>().transpose().solve(b);
  return solve_nnls(Q.transpose(), f);
}

int degree_for(std::size_t points) {
  int degree = 1;
  while (degree < highest_cut_cell_degree && count_of(degree + 1) <= points) ++degree;
  return degree;
}

}  // namespace

std::size_t count_of_gauss_points(std::size_t most_points) {
  const std::size_t moments = count_of(degree_for(most_points));
  return std::min(most_points, moments < 8 && most_points >= 8 ? 8 : moments);
}

CellPart::CellPart(const Solid& solid, const SpaceBox& box, std::size_t most_points)
    : solid_(solid),
      box_(box),
      most_points_(most_points),
      degree_(degree_for(most_points)),
      rule_(solid.rule(box, std::max(2, degree_))) {
  const VectorXd weight = vector_of_values(rule_.weight);
  volume_ = weight.size() == 0 ? 0 : weight.sum();
  if (empty()) return;
  Eigen::Matrix3Xd x = columns(rule_.x);
  const Eigen::Vector3d middle(box.middle().data());
  x.colwise() -= middle;
  centroid_ = x * weight / volume_;
  x.colwise() -= centroid_;
  centroid_ += middle;
  const Eigen::Matrix3d spread = x * weight.asDiagonal() * x.transpose() / volume_;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(spread);
  axes_ = principal.eigenvectors().transpose();
  const double least = 1e-12 * spread.trace();
  extent_ = (12 * spread.diagonal().cwiseMax(least)).cwiseSqrt();
  half_ = (3 * principal.eigenvalues().cwiseMax(least)).cwiseSqrt();
  moments_ = products(seen_from_part(rule_.x), degree_) * weight / volume_;
}

Eigen::Matrix3Xd CellPart::seen_from_part(const std::vector<SpacePoint>& x) const {
  return half_.cwiseInverse().asDiagonal() * (axes_ * (columns(x).colwise() - centroid_));
}

MatrixXd CellPart::products(const Eigen::Matrix3Xd& xi, int degree) {
  // (k + 1) P_{k+1} = (2 k + 1) ξ P_k − k P_{k−1}
  std::vector<Eigen::Array3Xd> P{Eigen::Array3Xd::Ones(3, xi.cols()), xi.array()};
  for (int k = 1; k < degree; ++k) {
    const auto last = static_cast<std::size_t>(k);
    P.emplace_back(((2 * k + 1) * xi.array() * P[last] - k * P[last - 1]) / (k + 1));
  }
  const auto of = [&](int power) -> const Eigen::Array3Xd& { return P[static_cast<std::size_t>(power)]; };
  MatrixXd rows(static_cast<Index>(count_of(degree)), xi.cols());
  Index row = 0;
  for (int total = 0; total <= degree; ++total)
    for (int i = 0; i <= total; ++i)
      for (int j = 0; i + j <= total; ++j) rows.row(row++) = of(i).row(0) * of(j).row(1) * of(total - i - j).row(2);
  return rows;
}

// The products yz, zx, xy and xyz along the axes of the grid.
MatrixXd CellPart::products_of_axes(const std::vector<SpacePoint>& x) const {
  const Eigen::Array3Xd xi = ((2 * extent_.cwiseInverse()).asDiagonal() * (columns(x).colwise() - centroid_)).array();
  MatrixXd rows(4, xi.cols());
  rows << xi.row(1) * xi.row(2), xi.row(2) * xi.row(0), xi.row(0) * xi.row(1), xi.row(0) * xi.row(1) * xi.row(2);
  return rows;
}

// Points of a Gauss–Legendre lattice that lie inside, of the coarsest lattice with enough of them.
std::vector<SpacePoint> CellPart::lattice_inside() const {
  std::vector<SpacePoint> inside;
  for (int n = 2 + degree_; inside.size() < count_of(degree_) && n <= 32; n *= 2) {
    inside.clear();
    const UnitRule along(2 * n - 1);
    for (const double c : along.at) {
      for (const double b : along.at) {
        for (const double a : along.at) {
          const SpacePoint x{std::lerp(box_.low[0], box_.high[0], a), std::lerp(box_.low[1], box_.high[1], b),
                             std::lerp(box_.low[2], box_.high[2], c)};
          if (solid_.contains(x)) inside.push_back(x);
        }
      }
    }
  }
  return inside;
}

std::vector<SpacePoint> CellPart::or_one(std::vector<SpacePoint> inside) const {
  if (!inside.empty()) return inside;
  const SpacePoint middle{centroid_[0], centroid_[1], centroid_[2]};
  if (solid_.contains(middle)) return {middle};
  const auto distance = [&](const SpacePoint& x) { return (Eigen::Vector3d(x.data()) - centroid_).squaredNorm(); };
  const std::vector<SpacePoint> some = solid_.rules_lie_inside() ? rule_.x : lattice_inside();
  if (some.empty()) return {middle};  // for a sliver: nothing nearer is known
  return {*std::ranges::min_element(some, {}, distance)};
}

SolidCellRule CellPart::with_shares(const std::vector<SpacePoint>& x, const VectorXd& share, int degree) const {
  SolidCellRule rule{{}, {}, degree};
  for (std::size_t p = 0; p < x.size(); ++p) {
    const double s = share(static_cast<Index>(p));
    if (s <= kNoShare) continue;
    rule.x.push_back(x[p]);
    rule.share.push_back(s);
  }
  return rule;
}

SolidCellRule CellPart::equal_shares(std::vector<SpacePoint> inside) const {
  const std::vector<SpacePoint> x = or_one(std::move(inside));
  const VectorXd share = equal(x.size());
  const VectorXd off = (products(seen_from_part(x), degree_) * share - moments_).cwiseAbs();
  int degree = 0;
  while (degree < degree_ && off.head(static_cast<Index>(count_of(degree + 1))).maxCoeff() <= kRoundingOfMoments)
    ++degree;
  return with_shares(x, share, degree);
}

SolidCellRule CellPart::fitted_shares(std::vector<SpacePoint> inside) const {
  const std::vector<SpacePoint> x = or_one(std::move(inside));
  const MatrixXd A = products(seen_from_part(x), degree_);
  VectorXd share = equal(x.size());
  int degree = 0;
  for (; degree < degree_; ++degree) {
    const auto rows = static_cast<Index>(count_of(degree + 1));
    const ConstrainedFit fit = nearest_nonnegative(A.topRows(rows), moments_.head(rows), equal(x.size()));
    if (!fit.weights) break;
    if ((A.topRows(rows) * *fit.weights - moments_.head(rows)).lpNorm<Eigen::Infinity>() > kRoundingOfMoments) break;
    share = *fit.weights;
  }
  return with_shares(x, share, degree);
}

// Shares of some of these points that integrate a degree; none if they do not.
std::optional<VectorXd> CellPart::shares_for(const std::vector<SpacePoint>& from, int degree) const {
  // Four points cannot resolve all of the trilinear functions, of which there are eight.
  const bool more = degree == 1 && most_points_ >= 8;
  const auto rows = static_cast<Index>(count_of(degree)), all = rows + (more ? 4 : 0);
  MatrixXd A(all, static_cast<Index>(from.size()));
  VectorXd b(all);
  A.topRows(rows) = products(seen_from_part(from), degree);
  b.head(rows) = moments_.head(rows);
  if (more) {
    A.bottomRows(4) = products_of_axes(from);
    b.tail(4) = products_of_axes(rule_.x) * vector_of_values(rule_.weight) / volume_;
  }
  const VectorXd share = solve_in_orthonormal_rows(A, b);
  if (!((A * share - b).lpNorm<Eigen::Infinity>() <= kRoundingOfMoments)) return std::nullopt;
  return share;
}

SolidCellRule CellPart::gauss_points() const {
  const std::vector<SpacePoint> from = solid_.rules_lie_inside() ? rule_.x : lattice_inside();
  for (int degree = degree_; degree > 0 && !from.empty(); --degree) {
    // A rule of the part has thousands of points: of far fewer there are such shares as well, nearly always.
    for (std::size_t every = std::max<std::size_t>(1, from.size() / (5 * count_of(degree)));; every = (every + 3) / 4) {
      const std::vector<SpacePoint> some = every_nth(from, every);
      if (const std::optional<VectorXd> share = shares_for(some, degree)) return with_shares(some, *share, degree);
      if (every == 1) break;
    }
  }
  return fitted_shares({});
}

}  // namespace stillpoint
