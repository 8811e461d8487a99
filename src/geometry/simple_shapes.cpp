#include "geometry/simple_shapes.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include <Eigen/Dense>
#include <fmt/format.h>

namespace stillpoint {
namespace {

template <int N>
class HalfSpace final : public RigidShape<N> {
 public:
  using typename RigidShape<N>::Position;

  HalfSpace(const Position& point, const Position& normal) : point_(point), normal_(normal.normalized()) {}
  Nearest<N> nearest(const Position& x) const override { return nearest_on_face<N>(normal_.dot(x - point_), normal_); }

 private:
  Position point_, normal_;
};

template <int N>
class Ball final : public RigidShape<N> {
 public:
  using typename RigidShape<N>::Position;
  using typename RigidShape<N>::Matrix;

  Ball(const Position& centre, double radius) : centre_(centre), radius_(radius) {}
  Nearest<N> nearest(const Position& x) const override {  // a corner, grown
    const Nearest<N> of_centre =
        nearest_on_feature<N>(x - centre_, Matrix::Zero(), false, Position::UnitX(), rounding_of(radius_));
    return grown(of_centre, radius_);
  }

 private:
  Position centre_;
  double radius_;
};

template <int N>
class Box final : public RigidShape<N> {
 public:
  using typename RigidShape<N>::Position;
  using typename RigidShape<N>::Matrix;

  Box(const Position& low, const Position& high, double rounding)
      : low_(low.array() + rounding), high_((high.array() - rounding).max(low_.array())), rounding_(rounding) {}
  Nearest<N> nearest(const Position& x) const override { return grown(nearest_of_shrunk(x), rounding_); }

 private:
  Nearest<N> nearest_of_shrunk(const Position& x) const {
    const Position offset = x - x.cwiseMax(low_).cwiseMin(high_);
    if ((offset.array() != 0).any()) {
      const Position sides = offset.array().sign();  // of the faces that x is beyond
      const Matrix T = (1 - sides.array().abs()).matrix().asDiagonal();
      return nearest_on_feature<N>(offset, T, false, sides.normalized(), 0);
    }
    Eigen::Index lower, upper;
    const double below = (low_ - x).maxCoeff(&lower), above = (x - high_).maxCoeff(&upper);
    if (below > above) return nearest_on_face<N>(below, -Position::Unit(lower));
    return nearest_on_face<N>(above, Position::Unit(upper));
  }

  Position low_, high_;  // of the shrunk box
  double rounding_;
};

class Wedge final : public RigidShape<2> {
 public:
  Wedge(const Position& tip, const Position& direction, double half_angle, double rounding)
      : direction_(direction.normalized()),
        across_(-direction_.y(), direction_.x()),
        tip_(tip + rounding / std::sin(half_angle) * direction_),
        sin_(std::sin(half_angle)),
        cos_(std::cos(half_angle)),
        rounding_(rounding) {}

  Nearest<2> nearest(const Position& x) const override {
    const Position offset = x - tip_, outwards = offset.dot(across_) < 0 ? -across_ : across_;
    const Position flank = cos_ * direction_ + sin_ * outwards, normal = cos_ * outwards - sin_ * direction_;
    const Nearest<2> of_shrunk =
        offset.dot(flank) >= 0
            ? nearest_on_face<2>(offset.dot(normal), normal)
            : nearest_on_feature<2>(offset, Matrix::Zero(), false, -direction_, rounding_of(tip_.lpNorm<1>()));
    return grown(of_shrunk, rounding_);
  }

 private:
  Position direction_, across_;
  Position tip_;  // of the shrunk wedge
  double sin_, cos_, rounding_;
};

/// True for a vector that has a direction.
template <class Direction>
bool is_direction(const Direction& direction) {
  return direction.allFinite() && direction.norm() > 0;
}

void require(bool right, const std::string& otherwise) {
  if (!right) throw std::invalid_argument(otherwise);
}

void require_rounding(double rounding, double largest) {
  require(rounding >= 0 && rounding <= largest,
          fmt::format("the rounding {} is not between 0 and {}, the largest of this shape", rounding, largest));
}

}  // namespace

template <int N>
RigidShapePtr<N> half_space(const Eigen::Vector<double, N>& point, const Eigen::Vector<double, N>& normal) {
  require(point.allFinite(), "the point of a half-space is not finite");
  require(is_direction(normal), "the normal of a half-space has no direction");
  return std::make_shared<HalfSpace<N>>(point, normal);
}

template <int N>
RigidShapePtr<N> ball(const Eigen::Vector<double, N>& centre, double radius) {
  require(centre.allFinite(), "the centre is not finite");
  require(radius > 0 && std::isfinite(radius), fmt::format("the radius {} is not positive and finite", radius));
  return std::make_shared<Ball<N>>(centre, radius);
}

template <int N>
RigidShapePtr<N> box(const Eigen::Vector<double, N>& low, const Eigen::Vector<double, N>& high, double rounding) {
  const Eigen::Vector<double, N> sides = high - low;
  require(sides.allFinite() && (sides.array() > 0).all(), "a box does not begin below its end along each axis");
  require_rounding(rounding, sides.minCoeff() / 2);
  return std::make_shared<Box<N>>(low, high, rounding);
}

RigidShapePtr<2> wedge(const Eigen::Vector2d& tip, const Eigen::Vector2d& direction, double half_angle,
                       double rounding) {
  require(tip.allFinite(), "the tip is not finite");
  require(is_direction(direction), "the direction from the tip is none");
  require(half_angle > 0 && half_angle < std::numbers::pi / 2,
          fmt::format("the half angle {} is not between 0 and pi/2", half_angle));
  require_rounding(rounding, std::numeric_limits<double>::max());
  return std::make_shared<Wedge>(tip, direction, half_angle, rounding);
}

template RigidShapePtr<2> half_space(const Eigen::Vector2d&, const Eigen::Vector2d&);
template RigidShapePtr<3> half_space(const Eigen::Vector3d&, const Eigen::Vector3d&);
template RigidShapePtr<2> ball(const Eigen::Vector2d&, double);
template RigidShapePtr<3> ball(const Eigen::Vector3d&, double);
template RigidShapePtr<2> box(const Eigen::Vector2d&, const Eigen::Vector2d&, double);
template RigidShapePtr<3> box(const Eigen::Vector3d&, const Eigen::Vector3d&, double);

}  // namespace stillpoint
