// What is ahead of a body that goes on in one direction: rays from its border to the rigid bodies.
#include "space/boundary/rigid_contact.hpp"

namespace stillpoint {

// Sphere tracing [Hart 1996]: as |∇φ| = 1, nothing is nearer than φ in any direction. What a ray comes to within a cell
// of is ahead if it comes nearer: between two rays there may be a piece of the rigid body that none of them meets.
template <Kinematics K>
bool RigidContact<K>::is_ahead(std::size_t body, const Point<dim>& direction, double t, const double* u) const {
  constexpr double towards = 1e-6;  // −n·d
  constexpr int looks = 400;        // along a ray, of at least their share of the grid's extent
  const Position d = TouchFinder<K>::position_of(direction);
  for (const RigidBody& rigid : bodies_) {
    const TouchFinder<K>& finder = rigid.finder();
    if (finder.is_free() || !finder.touches(body)) continue;
    const RigidPlacement<N> placement = finder.placement(t);
    for (const auto& patch : surface_.patches()) {
      if (patch.body != body) continue;
      for (std::size_t s = patch.begin; s < patch.end; ++s) {
        Position x = TouchFinder<K>::position_of(surface_.position(s, u));
        for (int look = 0; look < looks; ++look) {
          const Nearest<N> nearest = finder.nearest(x, placement);
          const double within = nearest.distance - patch.cell;
          if (within <= 0 && -nearest.normal.dot(d) > towards) return true;
          x += std::max(within, surface_.extent() / looks) * d;
        }
      }
    }
  }
  return false;
}

template bool RigidContact<Kinematics::line>::is_ahead(std::size_t, const Point<1>&, double, const double*) const;
template bool RigidContact<Kinematics::plane>::is_ahead(std::size_t, const Point<2>&, double, const double*) const;
template bool RigidContact<Kinematics::axisymmetric>::is_ahead(std::size_t, const Point<2>&, double,
                                                               const double*) const;
template bool RigidContact<Kinematics::space>::is_ahead(std::size_t, const Point<3>&, double, const double*) const;

}  // namespace stillpoint
