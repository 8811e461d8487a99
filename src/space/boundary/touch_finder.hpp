// The pieces of a surface that are near a rigid body.
//
// As |∇φ| = 1, a distance changes by no more than the way of the piece in the rigid body's axes. What was found when φ
// was evaluated at all pieces therefore tells that most of them, and most patches as a whole, cannot touch now. The
// answer is the same as by evaluating φ everywhere, to the bit.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "base/work_pool.hpp"
#include "geometry/rigid_placement.hpp"
#include "space/boundary/contact_surface.hpp"
#include "space/boundary/rigid_motion.hpp"

namespace stillpoint {

template <Kinematics K>
class TouchFinder {
  static constexpr int dim = dimensions(K);

 public:
  static constexpr int N = dim == 3 ? 3 : 2;  // a line has no rigid bodies
  using Position = Eigen::Vector<double, N>;

  /// A piece near the rigid body.
  struct Near {
    std::size_t patch, piece;
    Position x, X;  // its position, and that in the rigid body's axes [m]
    Nearest<N> at;  // φ with its derivatives, in the scene's axes
  };

  /// The problem, whose rigid body this is, and the surface must outlive this object; time_scale: see PrescribedMotion.
  TouchFinder(const Problem& problem, const RigidSpec& spec, const ContactSurface<K>& surface, double time_scale);

  const RigidSpec& spec() const { return *spec_; }
  bool is_free() const { return spec_->free; }
  /// The weight of a free body and the force on it [N].
  Position load(double t) const;
  bool touches(std::size_t body) const { return touches_[body] != 0; }
  RigidPlacement<N> placement(double t) const { return motion_.placement(t); }
  /// Whether its formulas depend on t.
  bool moves() const { return motion_.moves(); }
  /// As RigidMotion::move_on(). True if there is a way to go.
  bool move_on(double start, double share) {
    motion_.move_on(start, share);
    return motion_.moves();
  }
  void begin_phase() { ++phase_; }

  /// Calls visit(near) for each piece s at u, over the grid's functions, with φ ≤ reach(its patch); placement: of now.
  template <class Reach, class Visit>
  void for_near(const RigidPlacement<N>& placement, const double* u, const Reach& reach, const Visit& visit) const {
    const auto looks = this->looks(placement, u);
    const double turned = placement.Q == looks->placement.Q ? 0 : std::numeric_limits<double>::infinity();
    const double shift = turned + (placement.u - looks->placement.u).norm();
    const auto patches = surface_.patches();
    std::size_t found = 0, missed = 0;
    for (std::size_t k = 0; k < patches.size(); ++k) {
      const auto& patch = patches[k];
      if (!touches(patch.body)) continue;
      const double within = reach(k);
      if (looks->least[k] - within > way_of(patch, *looks) + shift) continue;
      for (std::size_t s = patch.begin; s < patch.end; ++s) {
        const Position x = position_of(surface_.position(s, u)), X = placement.to_body(x);
        const double away = looks->phi[s] - within;
        if (away > 0 && (X - looks->X[s]).squaredNorm() < away * away) continue;
        const Nearest<N> at = placement.nearest(*shape_, x);
        if (at.distance <= within) {
          ++found;
          visit(Near{k, s, x, X, at});
        } else {
          ++missed;
        }
      }
    }
    constexpr std::size_t few = 16;
    if (missed > few + found) looks->phase = -1;  // what was found is of too long ago
  }
  /// φ at a position, under a placement [m].
  double distance(const Point<dim>& x, const RigidPlacement<N>& placement) const {
    return shape_->nearest(placement.to_body(position_of(x))).distance;
  }

  /// The same with its derivatives.
  Nearest<N> nearest(const Position& x, const RigidPlacement<N>& placement) const {
    return placement.nearest(*shape_, x);
  }

  static Position position_of(const Point<dim>& x) {
    Position position = Position::Zero();
    for (int d = 0; d < dim; ++d) position[d] = x[static_cast<std::size_t>(d)];
    return position;
  }

 private:
  struct Looks {
    long phase = -1;  // that they are of
    RigidPlacement<N> placement;
    std::vector<Position> X;    // of the pieces, in the rigid body's axes [m]
    std::vector<double> phi;    // φ there [m]
    std::vector<double> least;  // the least of each patch [m]
    std::vector<double> u;      // of the surface's functions, (functions × dim) [m]
    std::vector<double> moved;  // |Δu| since then, (functions) [m]
  };
  using Loan = typename WorkPool<Looks>::Loan;

  /// What was found, and how far the functions have moved since.
  Loan looks(const RigidPlacement<N>& placement, const double* u) const;
  void look(const RigidPlacement<N>& placement, const double* u, Looks& looks) const;
  // The longest way that a piece of the patch may have gone; with room for rounding.
  double way_of(const typename ContactSurface<K>::Patch& patch, const Looks& looks) const {
    constexpr double rounding = 1e-9;
    const std::vector<int>& functions = surface_.functions_of_patches();
    double most = 0;
    for (std::size_t f = patch.first_function; f < patch.end_function; ++f)
      most = std::max(most, looks.moved[static_cast<std::size_t>(functions[f])]);
    return (1 + rounding) * (patch.weight * most + rounding * patch.cell);
  }

  const RigidSpec* spec_;
  const std::vector<Expression>& gravity_;  // the body force per mass, formulas of t [m/s²]; empty: 0
  const ContactSurface<K>& surface_;
  RigidShapePtr<N> shape_;
  RigidMotion<N> motion_;
  std::vector<char> touches_;  // (bodies)
  long phase_ = 0;
  WorkPool<Looks> looks_;
};

/// Whether a rigid body may touch a body, (bodies).
std::vector<char> bodies_touched_by(const Problem& problem, const RigidSpec& rigid);

}  // namespace stillpoint
