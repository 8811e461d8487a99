#include "space/boundary/touch_finder.hpp"

#include <cmath>

#include "scene/rigid_body.hpp"

namespace stillpoint {
namespace {

template <int N>
Eigen::Vector<double, N> about(const RigidSpec& spec) {
  Eigen::Vector<double, N> a = Eigen::Vector<double, N>::Zero();
  for (std::size_t d = 0; d < std::min<std::size_t>(N, spec.about.size()); ++d)
    a[static_cast<Eigen::Index>(d)] = spec.about[d];
  return a;
}

}  // namespace

std::vector<char> bodies_touched_by(const Problem& problem, const RigidSpec& rigid) {
  std::vector<char> touched;
  for (const BodySpec& body : problem.bodies) touched.push_back(rigid.touches(body.name));
  return touched;
}

template <Kinematics K>
TouchFinder<K>::TouchFinder(const Problem& problem, const RigidSpec& spec, const ContactSurface<K>& surface,
                            double time_scale)
    : spec_(&spec),
      gravity_(problem.body_force),
      surface_(surface),
      shape_(rigid_shape<N>(spec, K == Kinematics::axisymmetric)),
      motion_(spec.motion, spec.rotation, about<N>(spec), time_scale),
      touches_(bodies_touched_by(problem, spec)) {}

// Along the axis of symmetry alone: what acts across it cancels around it.
template <Kinematics K>
auto TouchFinder<K>::load(double t) const -> Position {
  Position load = Position::Zero();
  for (std::size_t i = K == Kinematics::axisymmetric ? 1 : 0; i < dim; ++i) {
    double& along = load[static_cast<Eigen::Index>(i)];
    if (i < spec_->force.size()) along += spec_->force[i]({}, t);
    if (i < gravity_.size() && spec_->mass > 0) along += spec_->mass * gravity_[i]({}, t);
  }
  return load;
}

template <Kinematics K>
auto TouchFinder<K>::looks(const RigidPlacement<N>& placement, const double* u) const -> Loan {
  Loan looks = looks_.borrow();
  const std::vector<int>& functions = surface_.functions();
  if (looks->phase != phase_ || looks->moved.size() != functions.size()) look(placement, u, *looks);
  for (std::size_t f = 0; f < functions.size(); ++f) {
    double square = 0;
    for (std::size_t i = 0; i < dim; ++i) {
      const double change = u[static_cast<std::size_t>(functions[f]) + i] - looks->u[dim * f + i];
      square += change * change;
    }
    looks->moved[f] = std::sqrt(square);
  }
  return looks;
}

template <Kinematics K>
void TouchFinder<K>::look(const RigidPlacement<N>& placement, const double* u, Looks& looks) const {
  const std::vector<int>& functions = surface_.functions();
  looks.phase = phase_;
  looks.placement = placement;
  looks.moved.assign(functions.size(), 0);
  looks.u.resize(dim * functions.size());
  for (std::size_t f = 0; f < functions.size(); ++f)
    std::copy_n(u + functions[f], dim, looks.u.begin() + static_cast<std::ptrdiff_t>(dim * f));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  looks.X.assign(surface_.size(), Position::Zero());
  looks.phi.assign(surface_.size(), infinity);
  looks.least.assign(surface_.patches().size(), infinity);
  for (std::size_t k = 0; k < looks.least.size(); ++k) {
    const auto& patch = surface_.patches()[k];
    if (!touches(patch.body)) continue;
    for (std::size_t s = patch.begin; s < patch.end; ++s) {
      looks.X[s] = placement.to_body(position_of(surface_.position(s, u)));
      looks.phi[s] = shape_->nearest(looks.X[s]).distance;
      looks.least[k] = std::min(looks.least[k], looks.phi[s]);
    }
  }
}

template class TouchFinder<Kinematics::line>;
template class TouchFinder<Kinematics::plane>;
template class TouchFinder<Kinematics::axisymmetric>;
template class TouchFinder<Kinematics::space>;

}  // namespace stillpoint
