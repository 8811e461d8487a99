#include "space/boundary/rigid_motion.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace stillpoint {
namespace {

std::vector<PrescribedMotion> motions(const std::vector<Expression>& formulas, Eigen::Index number, const char* what,
                                      double time_scale) {
  if (!formulas.empty() && static_cast<Eigen::Index>(formulas.size()) != number)
    throw std::invalid_argument(
        fmt::format("the {} of a rigid body has {} formulas, not {}", what, number, formulas.size()));
  std::vector<PrescribedMotion> made;
  for (const Expression& formula : formulas) {
    if (formula.uses_position())
      throw std::invalid_argument(fmt::format("the {} of a rigid body varies in space: '{}'", what, formula.text()));
    made.emplace_back(formula, time_scale);
  }
  return made;
}

}  // namespace

template <int N>
RigidMotion<N>::RigidMotion(const std::vector<Expression>& translation, const std::vector<Expression>& rotation,
                            const Eigen::Vector<double, N>& about, double time_scale)
    : translation_(motions(translation, N, "translation", time_scale)),
      rotation_(motions(rotation, Turning<N>::RowsAtCompileTime, "rotation", time_scale)),
      about_(about) {}

template <int N>
bool RigidMotion<N>::moves() const {
  return std::ranges::any_of(translation_, &PrescribedMotion::moves) ||
         std::ranges::any_of(rotation_, &PrescribedMotion::moves);
}

template <int N>
double RigidMotion<N>::displacement(const PrescribedMotion& of, double t) const {
  if (share_ == 1) return of.displacement(t);
  const double before = of.displacement(start_);
  return before + share_ * (of.displacement(t) - before);
}

template <int N>
RigidPlacement<N> RigidMotion<N>::placement(double t) const {
  RigidPlacement<N> placement{.a = about_};
  Turning<N> theta = Turning<N>::Zero();
  for (Eigen::Index i = 0; const PrescribedMotion& u : translation_) placement.u[i++] = displacement(u, t);
  for (Eigen::Index i = 0; const PrescribedMotion& angle : rotation_) theta[i++] = displacement(angle, t);
  placement.Q = stillpoint::rotation<N>(theta);
  return placement;
}

template <int N>
RigidPlacement<N> RigidMotion<N>::at(double t) const {
  RigidPlacement<N> placement = this->placement(t);
  Turning<N> theta = Turning<N>::Zero(), dtheta_dt = Turning<N>::Zero();
  for (Eigen::Index i = 0; const PrescribedMotion& u : translation_) placement.du_dt[i++] = u.velocity(t);
  for (Eigen::Index i = 0; const PrescribedMotion& angle : rotation_) {
    theta[i] = displacement(angle, t);
    dtheta_dt[i++] = angle.velocity(t);
  }
  placement.Omega = spin<N>(theta, dtheta_dt);
  return placement;
}

template class RigidMotion<2>;
template class RigidMotion<3>;

}  // namespace stillpoint
