#include "geometry/simple_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

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
  Wedge(const Position& tip, const Position& direction, double half_angle, double rounding, double shaft_radius)
      : direction_(direction.normalized()),
        across_(-direction_.y(), direction_.x()),
        tip_(tip + rounding / std::sin(half_angle) * direction_),
        sin_(std::sin(half_angle)),
        cos_(std::cos(half_angle)),
        rounding_(rounding),
        shaft_radius_(shaft_radius - rounding),
        flank_length_(shaft_radius_ / sin_),
        shoulder_(shaft_radius_ * cos_ / sin_) {}

  // Comparisons with NaN lead to a face.
  Nearest<2> nearest(const Position& x) const override { return grown(nearest_of_shrunk(x), rounding_); }

 private:
  Nearest<2> nearest_of_shrunk(const Position& x) const {
    const Position offset = x - tip_, outwards = offset.dot(across_) < 0 ? -across_ : across_;
    const Position flank = cos_ * direction_ + sin_ * outwards, normal = cos_ * outwards - sin_ * direction_;
    const double along_flank = offset.dot(flank), s = offset.dot(direction_);
    if (along_flank < 0) return nearest_on_corner(offset, -direction_);
    if (along_flank > flank_length_ && s < shoulder_)
      return nearest_on_corner(offset - shoulder_ * direction_ - shaft_radius_ * outwards,
                               (normal + outwards).normalized());
    const double from_flank = offset.dot(normal), from_shaft = offset.dot(outwards) - shaft_radius_;
    return from_flank > from_shaft ? nearest_on_face<2>(from_flank, normal) : nearest_on_face<2>(from_shaft, outwards);
  }
  Nearest<2> nearest_on_corner(const Position& offset, const Position& normal_there) const {
    return nearest_on_feature<2>(offset, Matrix::Zero(), false, normal_there, rounding_of(tip_.lpNorm<1>()));
  }

  Position direction_, across_;
  Position tip_;  // of the shrunk wedge, as the rest
  double sin_, cos_, rounding_;
  double shaft_radius_, flank_length_;  // infinite: it has no shaft
  double shoulder_;                     // the distance along the direction from the tip to where the shaft begins
};

class Outside final : public RigidShape<2> {
 public:
  explicit Outside(RigidShapePtr<2> shape) : shape_(std::move(shape)) {}
  Nearest<2> nearest(const Position& x) const override {
    const Nearest<2> of_shape = shape_->nearest(x);
    return {-of_shape.distance, -of_shape.normal, -of_shape.hessian};
  }

 private:
  RigidShapePtr<2> shape_;
};

/// True for a vector that has a direction. One whose square is no number has none that can be computed.
template <class Direction>
bool is_direction(const Direction& direction) {
  return std::isfinite(direction.norm()) && direction.norm() > 0;
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

RigidShapePtr<2> wedge(const Eigen::Vector2d& tip, const Eigen::Vector2d& direction, double half_angle, double rounding,
                       double shaft_radius) {
  require(tip.allFinite(), "the tip is not finite");
  require(is_direction(direction), "the direction from the tip is none");
  require(half_angle > 0 && half_angle < std::numbers::pi / 2,
          fmt::format("the half angle {} is not between 0 and pi/2", half_angle));
  require(shaft_radius > 0, fmt::format("the radius {} of the shaft is not positive", shaft_radius));
  require_rounding(rounding, std::min(shaft_radius, std::numeric_limits<double>::max()));
  return std::make_shared<Wedge>(tip, direction, half_angle, rounding, shaft_radius);
}

RigidShapePtr<2> outside_of(RigidShapePtr<2> shape) { return std::make_shared<Outside>(std::move(shape)); }

template RigidShapePtr<2> half_space(const Eigen::Vector2d&, const Eigen::Vector2d&);
template RigidShapePtr<3> half_space(const Eigen::Vector3d&, const Eigen::Vector3d&);
template RigidShapePtr<2> ball(const Eigen::Vector2d&, double);
template RigidShapePtr<3> ball(const Eigen::Vector3d&, double);
template RigidShapePtr<2> box(const Eigen::Vector2d&, const Eigen::Vector2d&, double);
template RigidShapePtr<3> box(const Eigen::Vector3d&, const Eigen::Vector3d&, double);

}  // namespace stillpoint
