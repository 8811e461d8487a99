#include "geometry/quadric_solid.hpp"

#include <cmath>
#include <cstddef>

#include <Eigen/Dense>

#include "geometry/gauss_rule.hpp"

namespace stillpoint {
namespace {

constexpr double kNoCoefficient = 1e-13;  // relative to quadrics whose largest coefficient is 1

/// q in terms of fewer variables y: [x; 1] = T [y; 1].
template <int N>
Quadric<N - 1> in_terms_of(const Quadric<N>& q, const Eigen::Matrix<double, N + 1, N>& T) {
  return T.transpose() * q * T;
}

/// q in terms of all variables but one, which has this value.
template <int N>
Quadric<N - 1> with_fixed(const Quadric<N>& q, int variable, double value) {
  Eigen::Matrix<double, N + 1, N> T = Eigen::Matrix<double, N + 1, N>::Zero();
  for (int i = 0, column = 0; i <= N; ++i)
    if (i != variable) T(i, column++) = 1;
  T(variable, N - 1) = value;
  return in_terms_of<N>(q, T);
}

/// The quadric in the other variables that vanishes where q has a double root in its first variable.
template <int N>
Quadric<N - 1> discriminant(const Quadric<N>& q) {
  const Eigen::Matrix<double, N, 1> mixed = q.template block<N, 1>(1, 0);
  return q.template bottomRightCorner<N, N>() - mixed * mixed.transpose() / q(0, 0);
}

template <int N>
bool is_plane(const Quadric<N>& q) {
  return (q.template topLeftCorner<N, N>().array().abs() < kNoCoefficient).all();
}

/// q restricted to a plane that is not parallel to the first variable's axis.
template <int N>
Quadric<N - 1> on_plane(const Quadric<N>& q, const Quadric<N>& plane) {
  Eigen::Matrix<double, N + 1, N> T = Eigen::Matrix<double, N + 1, N>::Zero();
  for (int i = 1; i <= N; ++i) T(i, i - 1) = 1;
  for (int i = 1; i < N; ++i) T(0, i - 1) = -plane(i, N) / plane(0, N);
  T(0, N - 1) = -plane(N, N) / (2 * plane(0, N));
  return in_terms_of<N>(q, T);
}

template <int N>
void scale(Quadric<N>& q) {
  const double largest = q.cwiseAbs().maxCoeff();
  if (largest > 0) q /= largest;
}

/// Adds the real roots of a quadric of one variable that lie in (0, 1).
void add_roots(const Quadric<1>& q, std::vector<double>& at) {
  const double a = q(0, 0), b = q(0, 1), c = q(1, 1), discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return;
  const double s = -(b + std::copysign(std::sqrt(discriminant), b));
  for (const double root : {s / a, c / s})
    if (root > 0 && root < 1) at.push_back(root);
}

/// Adds the values of the last variable at which the integral over all others, each from 0 to 1, is not smooth.
template <int N>
void add_breaks(const std::vector<Quadric<N>>& quadrics, std::vector<double>& at) {
  if constexpr (N == 1) {
    for (const Quadric<1>& q : quadrics) add_roots(q, at);
  } else {
    std::vector<Quadric<N - 1>> fewer;
    for (std::size_t k = 0; k < quadrics.size(); ++k) {
      const Quadric<N>& q = quadrics[k];
      fewer.push_back(with_fixed<N>(q, 0, 0));
      fewer.push_back(with_fixed<N>(q, 0, 1));
      if (std::abs(q(0, 0)) > kNoCoefficient) fewer.push_back(discriminant<N>(q));
      for (std::size_t l = 0; l < quadrics.size(); ++l) {
        if (l != k && is_plane<N>(quadrics[l]) && std::abs(quadrics[l](0, N)) > kNoCoefficient)
          fewer.push_back(on_plane<N>(q, quadrics[l]));
      }
    }
    for (Quadric<N - 1>& q : fewer) scale<N - 1>(q);
    add_breaks<N - 1>(fewer, at);
  }
}

template <int N>
std::vector<double> breaks(const std::vector<Quadric<N>>& quadrics) {
  constexpr double rounding = 1e-12;
  std::vector<double> at{0, 1};
  add_breaks<N>(quadrics, at);
  std::ranges::sort(at);
  at.erase(std::unique(at.begin(), at.end(), [](double a, double b) { return b - a < rounding; }), at.end());
  at.back() = 1;
  return at;
}

/// A quadrature rule in the unit cube.
class QuadricRule {
 public:
  explicit QuadricRule(int degree) : along_x_(degree), across_(std::max(15, 3 * (degree + 2) + 2)) {
    for (std::size_t k = 0; k < across_.at.size(); ++k) {
      const double s = across_.at[k];
      across_.at[k] = s * s * (3 - 2 * s);
      across_.weight[k] *= 6 * s * (1 - s);
    }
  }

  SpaceRule take(const std::vector<Quadric<3>>& quadrics) {
    over<3>(quadrics, 1);
    return std::move(rule_);
  }

 private:
  template <int N>
  void over(const std::vector<Quadric<N>>& quadrics, double weight) {
    const std::vector<double> at = breaks<N>(quadrics);
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      const double width = at[k + 1] - at[k];
      if constexpr (N == 1) {
        if (is_inside(quadrics, at[k] + width / 2)) add_interval(at[k], width, weight);
      } else {
        for (std::size_t i = 0; i < across_.at.size(); ++i) {
          x_[N - 1] = at[k] + across_.at[i] * width;
          std::vector<Quadric<N - 1>> sliced;
          for (const Quadric<N>& q : quadrics) sliced.push_back(with_fixed<N>(q, N - 1, x_[N - 1]));
          over<N - 1>(sliced, weight * across_.weight[i] * width);
        }
      }
    }
  }
  static bool is_inside(const std::vector<Quadric<1>>& quadrics, double x) {
    return std::ranges::all_of(quadrics,
                               [&](const Quadric<1>& q) { return (q(0, 0) * x + 2 * q(0, 1)) * x + q(1, 1) <= 0; });
  }
  void add_interval(double from, double width, double weight) {
    for (std::size_t i = 0; i < along_x_.at.size(); ++i) {
      x_[0] = from + along_x_.at[i] * width;
      rule_.x.push_back(x_);
      rule_.weight.push_back(weight * along_x_.weight[i] * width);
    }
  }

  UnitRule along_x_, across_;
  SpacePoint x_{};
  SpaceRule rule_;
};

Eigen::Vector3d vector_of(const SpacePoint& x) { return {x[0], x[1], x[2]}; }

/// The quadric xᵀ A x − c, with A having eigenvalues 0 and 1.
Quadric<3> round_about_origin(const Eigen::Matrix3d& A, double c) {
  Quadric<3> q = Quadric<3>::Zero();
  q.topLeftCorner<3, 3>() = A;
  q(3, 3) = -c;
  return q;
}

}  // namespace

QuadricSolid QuadricSolid::sphere(const SpacePoint& centre, double radius, double inner) {
  SpaceBox bounds{centre, centre};
  for (std::size_t d = 0; d < 3; ++d) bounds.low[d] -= radius, bounds.high[d] += radius;
  QuadricSolid solid(centre, bounds);
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  solid.quadrics_.push_back(round_about_origin(I, radius * radius));
  if (inner > 0) solid.quadrics_.emplace_back(-round_about_origin(I, inner * inner));
  return solid;
}

QuadricSolid QuadricSolid::cylinder(const SpacePoint& from, const SpacePoint& to, double radius, double inner) {
  const Eigen::Vector3d along = vector_of(to) - vector_of(from);
  const double length = along.norm();
  const Eigen::Vector3d a = along / length;
  SpaceBox bounds;
  for (std::size_t d = 0; d < 3; ++d) {
    const double across = radius * std::sqrt(std::max(0.0, 1 - a[d] * a[d]));
    bounds.low[d] = std::min(from[d], to[d]) - across;
    bounds.high[d] = std::max(from[d], to[d]) + across;
  }
  QuadricSolid solid(from, bounds);
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - a * a.transpose();
  solid.quadrics_.push_back(round_about_origin(P, radius * radius));
  if (inner > 0) solid.quadrics_.emplace_back(-round_about_origin(P, inner * inner));
  for (const double end : {0.0, length}) {
    Quadric<3> plane = Quadric<3>::Zero();  // ±(a·x − end)
    plane.topRightCorner<3, 1>() = a / 2;
    plane.bottomLeftCorner<1, 3>() = a.transpose() / 2;
    plane(3, 3) = -end;
    solid.quadrics_.emplace_back(end > 0 ? plane : -plane);
  }
  return solid;
}

Eigen::Vector3d QuadricSolid::seen_from_origin(const SpacePoint& x) const { return vector_of(x) - vector_of(origin_); }

bool QuadricSolid::contains(const SpacePoint& x) const {
  const Eigen::Vector4d at = seen_from_origin(x).homogeneous();
  return std::ranges::all_of(quadrics_, [&](const Quadric<3>& q) { return at.dot(q * at) <= 0; });
}

// Bounds φ(m + d) = φ(m) + g·d + dᵀ A d over the box,  |d_i| ≤ h_i.
Solid::Part QuadricSolid::part_of(const SpaceBox& box) const {
  const Eigen::Vector4d m = seen_from_origin(box.middle()).homogeneous();
  const Eigen::Vector3d h = (vector_of(box.high) - vector_of(box.low)) / 2;
  Part part = Part::all;
  for (const Quadric<3>& q : quadrics_) {
    const Eigen::Vector4d of_middle = q * m;
    const double value = m.dot(of_middle), slope = 2 * of_middle.head<3>().cwiseAbs().dot(h);
    const double bend = h.dot(q.topLeftCorner<3, 3>().cwiseAbs() * h);
    if (value - slope - bend > 0) return Part::none;
    if (!(value + slope + bend <= 0)) part = Part::some;
  }
  return part;
}

SpaceRule QuadricSolid::rule(const SpaceBox& box, int degree) const {
  Eigen::Matrix4d from_unit = Eigen::Matrix4d::Identity();
  from_unit.topRightCorner<3, 1>() = seen_from_origin(box.low);
  for (std::size_t d = 0; d < 3; ++d)
    from_unit(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(d)) = box.high[d] - box.low[d];
  std::vector<Quadric<3>> local;
  for (const Quadric<3>& q : quadrics_) scale<3>(local.emplace_back(from_unit.transpose() * q * from_unit));
  SpaceRule rule = QuadricRule(degree).take(local);
  const double volume = box.volume();
  for (double& weight : rule.weight) weight *= volume;
  for (SpacePoint& x : rule.x)
    for (std::size_t d = 0; d < 3; ++d) x[d] = box.low[d] + x[d] * (box.high[d] - box.low[d]);
  return rule;
}

}  // namespace stillpoint
