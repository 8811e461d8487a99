#include "space/points/cut_cell_rule.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "space/points/moment_fit.hpp"

namespace stillpoint {
namespace {

using Eigen::Index;

constexpr double kMomentRounding = 1e-11;  // for moments of order one
constexpr double kNoShareOfCell = 1e-12;

Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
}

/// The box along the principal axes of a part of a cell; in its coordinates moments are of order one, however thin the
/// part and whatever its orientation. A polynomial keeps its total degree.
class PrincipalBox {
 public:
  explicit PrincipalBox(const Polygon& part) {
    const PlaneRule rule = polygon_rule(part, 2);
    Eigen::Matrix2Xd x = positions(rule.x);
    x.colwise() -= x * as_vector(rule.share);
    axes_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(x * as_vector(rule.share).asDiagonal() * x.transpose())
                .eigenvectors()
                .transpose();
    const Eigen::Matrix2Xd corners = axes_ * positions(part);
    low_ = corners.rowwise().minCoeff();
    high_ = corners.rowwise().maxCoeff();
  }
  /// The positions in the coordinates of the box, [−1, 1]², (2 × n).
  Eigen::MatrixXd xi(const std::vector<PlanePoint>& x) const {
    const Eigen::Array2Xd along = (axes_ * positions(x)).colwise() - (low_ + high_) / 2;
    return along.colwise() / ((high_ - low_) / 2).array();
  }

 private:
  static Eigen::Map<const Eigen::Matrix2Xd> positions(const std::vector<PlanePoint>& x) {
    return {x.front().data(), 2, static_cast<Index>(x.size())};
  }
  Eigen::Matrix2d axes_;  // one in each row
  Eigen::Vector2d low_, high_;
};

class Moments {
 public:
  explicit Moments(const Polygon& part)
      : box_(part), rule_(polygon_rule(part, highest_cut_cell_degree)), share_(as_vector(rule_.share)) {
    xi_ = box_.xi(rule_.x);
  }
  const PrincipalBox& box() const { return box_; }
  /// The means over the part of the Legendre products of this total degree.
  Eigen::VectorXd of_degree(int degree) const { return legendre_products(xi_, degree) * share_; }

 private:
  PrincipalBox box_;
  PlaneRule rule_;
  Eigen::VectorXd share_;
  Eigen::MatrixXd xi_;
};

/// The rule of the points x and their shares, without the points whose share is 0.
PlaneRule with_shares(const std::vector<PlanePoint>& x, const Eigen::VectorXd& share) {
  PlaneRule rule;
  for (std::size_t p = 0; p < x.size(); ++p) {
    const double s = share(static_cast<Index>(p));
    if (s <= kNoShareOfCell) continue;
    rule.x.push_back(x[p]);
    rule.share.push_back(s);
  }
  return rule;
}

/// Reduces a rule to as many points as A has rows, with shares ≥ 0 and the same sums A share: along a null vector z of
/// A over the lightest points, one more than it has rows, share − t z keeps the sums until a share vanishes [Tchakaloff
/// 1957; Davis 1967].
PlaneRule thinned(PlaneRule rule, Eigen::MatrixXd A) {
  const Index m = A.rows();
  while (A.cols() > m) {
    std::vector<Index> order(static_cast<std::size_t>(A.cols()));
    std::iota(order.begin(), order.end(), Index{0});
    const auto share_of = [&](Index p) -> double& { return rule.share[static_cast<std::size_t>(p)]; };
    std::ranges::stable_sort(order, {}, share_of);
    order.resize(static_cast<std::size_t>(m) + 1);
    Eigen::MatrixXd transposed(m + 1, m);
    for (Index k = 0; k <= m; ++k) transposed.row(k) = A.col(order[static_cast<std::size_t>(k)]).transpose();
    const Eigen::VectorXd z =
        Eigen::HouseholderQR<Eigen::MatrixXd>(transposed).householderQ() * Eigen::VectorXd::Unit(m + 1, m);
    double t = std::numeric_limits<double>::infinity();
    Index first = 0;  // the point whose share vanishes first
    for (Index k = 0; k <= m; ++k) {
      const double lasts = z(k) > 0 ? share_of(order[static_cast<std::size_t>(k)]) / z(k) : t;
      if (lasts < t) t = lasts, first = k;
    }
    for (Index k = 0; k <= m; ++k) {
      double& share = share_of(order[static_cast<std::size_t>(k)]);
      share = std::max(share - t * z(k), 0.0);
    }
    const Index out = order[static_cast<std::size_t>(first)], last = A.cols() - 1;
    rule.x[static_cast<std::size_t>(out)] = rule.x.back();
    share_of(out) = rule.share.back();
    rule.x.pop_back();
    rule.share.pop_back();
    A.col(out) = A.col(last).eval();
    A.conservativeResize(m, last);
  }
  return rule;
}

}  // namespace

CutCellRule equal_shares(const Polygon& part, const std::vector<PlanePoint>& inside) {
  const Moments moments(part);
  const Eigen::MatrixXd xi = moments.box().xi(inside);
  const auto n = static_cast<Index>(inside.size());
  const Eigen::VectorXd share = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  CutCellRule cut{with_shares(inside, share), 0};
  while (cut.degree < highest_cut_cell_degree) {
    const Eigen::VectorXd off = legendre_products(xi, cut.degree + 1) * share - moments.of_degree(cut.degree + 1);
    if (off.lpNorm<Eigen::Infinity>() > kMomentRounding) break;
    ++cut.degree;
  }
  return cut;
}

CutCellRule fitted_shares(const Polygon& part, const std::vector<PlanePoint>& inside) {
  const Moments moments(part);
  const Eigen::MatrixXd xi = moments.box().xi(inside);
  const auto n = static_cast<Index>(inside.size());
  const Eigen::VectorXd equal = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  Eigen::VectorXd share = equal, b = Eigen::VectorXd::Ones(1);
  Eigen::MatrixXd A = Eigen::MatrixXd::Ones(1, n);  // the shares sum to 1
  int degree = 0;
  while (degree < highest_cut_cell_degree) {
    const Eigen::MatrixXd rows = legendre_products(xi, degree + 1);
    Eigen::MatrixXd A_more(A.rows() + rows.rows(), n);
    Eigen::VectorXd b_more(A_more.rows());
    A_more << A, rows;
    b_more << b, moments.of_degree(degree + 1);
    const ConstrainedFit fit = nearest_nonnegative(A_more, b_more, equal);
    if (!fit.weights || (A_more * *fit.weights - b_more).lpNorm<Eigen::Infinity>() > kMomentRounding) break;
    share = *fit.weights;
    A = A_more;
    b = b_more;
    ++degree;
  }
  return {with_shares(inside, share), degree};
}

CutCellRule gauss_points(const Polygon& part, std::size_t most) {
  const PrincipalBox box(part);
  for (int degree = highest_cut_cell_degree; degree > 0; --degree) {
    const std::size_t moments = static_cast<std::size_t>((degree + 1) * (degree + 2)) / 2;
    const PlaneRule all = polygon_rule(part, degree);
    if (all.x.size() <= most) return {all, degree};
    if (moments > most) continue;
    const Eigen::MatrixXd xi = box.xi(all.x);
    Eigen::MatrixXd A(static_cast<Index>(moments), xi.cols());
    for (int d = 0, row = 0; d <= degree; row += ++d) A.middleRows(row, d + 1) = legendre_products(xi, d);
    const PlaneRule thin = thinned(all, A);
    return {with_shares(thin.x, as_vector(thin.share)), degree};
  }
  const PlanePoint middle = centroid(part);
  if (contains(part, middle)) return {{{middle}, {1.0}}, 1};
  return {{{polygon_rule(part, 0).x.front()}, {1.0}}, 0};
}

}  // namespace stillpoint
