#include "geometry/revolved_shape.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <Eigen/Dense>

#include "geometry/simple_shapes.hpp"

namespace stillpoint {
namespace {

class RevolvedShape final : public RigidShape<3> {
 public:
  RevolvedShape(RigidShapePtr<2> profile, const Position& origin, const Position& axis)
      : profile_(std::move(profile)), origin_(origin), axis_(axis.normalized()) {}

  Nearest<3> nearest(const Position& x) const override {
    const Position offset = x - origin_;
    const double z = offset.dot(axis_);
    const Position away = offset - z * axis_;
    const double r = away.norm();
    const bool on_axis = r <= rounding_of(offset.norm());
    const Position e = on_axis ? axis_.unitOrthogonal() : Position(away / r);
    const Nearest<2> in_profile = profile_->nearest({r, z});
    const double around = on_axis ? in_profile.hessian(0, 0) : in_profile.normal[0] / r;
    Eigen::Matrix<double, 3, 2> plane;  // the directions of the profile's coordinates
    plane << e, axis_;
    return {in_profile.distance, plane * in_profile.normal,
            plane * in_profile.hessian * plane.transpose() + around * (Matrix::Identity() - plane * plane.transpose())};
  }

 private:
  RigidShapePtr<2> profile_;
  Position origin_, axis_;
};

}  // namespace

RigidShapePtr<3> revolved(RigidShapePtr<2> profile, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis) {
  if (!origin.allFinite()) throw std::invalid_argument("the origin of an axis is not finite");
  if (!std::isfinite(axis.norm()) || !(axis.norm() > 0)) throw std::invalid_argument("an axis has no direction");
  return std::make_shared<RevolvedShape>(std::move(profile), origin, axis);
}

RigidShapePtr<3> cylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, double rounding) {
  return revolved(box<2>({-radius, 0}, {radius, (to - from).norm()}, rounding), from, to - from);
}

RigidShapePtr<3> cone(const Eigen::Vector3d& tip, const Eigen::Vector3d& direction, double half_angle, double rounding,
                      double shaft_radius) {
  return revolved(wedge({0, 0}, {0, 1}, half_angle, rounding, shaft_radius), tip, direction);
}

}  // namespace stillpoint
