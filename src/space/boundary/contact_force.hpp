// Contact of a border with what it may touch: a force in R(u), exact when open.
//
// A piece s of the border (ContactSurface) with the area A is at x(u); what it may touch is known by a signed distance
// φ, placed by T(t): a rigid body (TouchFinder), or another body's border (FacetFinder), where x is the position
// relative to that body.
//
//   g = φ(T⁻¹ x),   p = max(0, λ − κ g),   f = A (p n + τ),   R −= w f,   n = ∇φ
//
// κ: the stiffness of its patch; λ: the multiplier, the pressure that needs no penetration. Without friction R has the
// potential Σ A p²/(2 κ), and its tangent is symmetric,
//
//   ∂f/∂x = −A (κ n nᵀ − p ∇n).
//
// A penalty alone gives way by p/κ. The augmented Lagrangian [Simo and Laursen 1992] takes that back: in equilibrium λ
// becomes what the grid's functions can tell of p, or in bodies that deform much its mean over the patch
// (contact_multipliers.hpp), and the body goes on to where g has no such part.
//
// Friction [Coulomb] and adhesion c: with the anchor a, the position T⁻¹ x at which the piece stuck last, the elastic
// slip s = (I − n nᵀ)(T⁻¹ x − a) and the multiplier λ_t,
//
//   τ = clip(λ_t − κ s) to |τ| ≤ c + μ p where p > 0,   rough: no limit.
//
// Where it slips, the anchor is dragged along when a step is accepted, so that κ s = λ_t − τ there: R depends on the
// committed state, and has no potential.
//
// From phase to phase what carries the pieces moves those of a patch a little apart, by what no function of the grid
// feels. The border would become rough, and be touched at ever fewer pieces of all. At the end of a phase the pieces of
// a patch that touches therefore go to the mean gap of those that do.
//
// A free rigid body has no inertia: at any u it is displaced by the d at which its load W and what it touches balance,
//
//   W = Σ f(u, d),   so that   δd = (Σ A S)⁻¹ Σ A S δx,   S = −∂f/∂x,
//
// along axes along which nothing resists by nothing. R keeps a potential, the least of Σ A p²/(2 κ) − W·d over d, and
// is softer than with the body at rest: the critical step is no shorter.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "space/boundary/condition_reports.hpp"
#include "space/boundary/contact_law.hpp"
#include "space/boundary/contact_multipliers.hpp"
#include "space/boundary/contact_surface.hpp"
#include "space/boundary/free_rigid_body.hpp"
#include "space/boundary/touch_finder.hpp"

namespace stillpoint {

/// How well the multipliers of contact fit, in sums over all that touches.
struct ContactFit {
  explicit ContactFit(std::size_t unknowns) : forces(unknowns, 0.0), changes(unknowns, 0.0) {}

  bool touches = false, balanced = true;
  double misfit = 0;  // the largest penetration, or gap, that the grid's functions can tell [cells]
  // What the unknowns feel of the pressures, and of the changes of the multipliers by them, (n) each [N].
  std::vector<double> forces, changes;

  ContactState state() const;
};

/// Finder: TouchFinder or FacetFinder.
template <Kinematics K, class Finder>
class ContactForce {
  static constexpr int dim = dimensions(K), N = TouchFinder<K>::N;

 public:
  using Position = Eigen::Vector<double, N>;
  using Matrix = Eigen::Matrix<double, N, N>;

  using Touch = ContactTouch<K>;

  /// The surface must outlive this object.
  ContactForce(const ContactSurface<K>& surface, Finder finder, const ShearLimit& shear)
      : surface_(surface),
        finder_(std::move(finder)),
        shear_(shear),
        multipliers_(surface, shear.acts()),
        anchor_(shear.acts() ? surface.size() : 0, Position::Zero()),
        closed_(anchor_.size(), 0) {}

  Finder& finder() { return finder_; }
  const Finder& finder() const { return finder_; }
  bool remembers() const { return shear_.acts(); }
  /// Before the first phase, or the first of a stage: nothing bears yet, however many pieces the surface has by then.
  void begin_on_surface() { resize(); }
  /// Sets the anchors where the pieces are when a phase begins, less the slip that each has had.
  void anchor_at_start(double t, const std::vector<Position>& slip);
  /// The same in the first phase of a stage, of the pieces that the stage before did not have.
  void anchor_new_at_start(double t);
  /// The elastic slip of each piece, T⁻¹ x − a, (pieces); empty without friction.
  std::vector<Position> slips(double t, const double* u) const;
  void archive(const StateArchive& state);
  /// After begin_on_surface(): takes over what the stage before remembers.
  void take_over(const StateArchive& state);
  /// Whether it acted on a body in the stage before.
  bool was_there(std::size_t body) const { return body < was_there_.size() && was_there_[body]; }

  /// R −= the forces on the border at (t, u), (n); at_supports: the same at prescribed unknowns. of_patches += those on
  /// each patch, component by component, (dim × patches); may be empty.
  void add_force(double t, const double* u, Vec R, Vec at_supports, Vec of_patches) const;
  /// dR += the derivative of these forces along du, over the grid's functions.
  void add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const;
  /// Appends the entries of their matrix.
  void add_entries(Tangent kind, double t, const double* u, MatrixEntries& entries) const;

  /// Accepts the state at (t, u): anchors are dragged to where pieces slip, and a free body is looked for from there
  /// on.
  void commit(double t, const double* u);
  /// What slip has taken at all commits, Σ A |τ| |Δa| [J].
  double friction_work() const { return friction_work_; }
  /// Takes the pressures at (t, u) as multipliers; evenly: by changes that are smoothed (patch_neighbours.hpp), of
  /// which there may be any number, and which are not counted.
  void update_multipliers(double t, const double* u, bool evenly);
  /// Whether a piece bears a pressure.
  bool is_touched(double t, const double* u) const;
  /// fit: for the unknowns of the phase.
  void add_fit(double t, const double* u, ContactFit& fit) const;
  /// The mean gaps of the patches where they bear a pressure, (patches) [m]; NaN of a patch that bears none.
  std::vector<double> mean_gaps(double t, const double* u) const;
  /// The ways by which pieces of the surface come to the mean gaps of their patches, at the end of a phase, (pieces)
  /// [m]; empty without contact.
  std::vector<Position> ways_to_mean_gap(double t, const double* u) const;
  /// Takes over the multipliers where the surface was cut anew, which makes slip, (pieces), that of the new pieces:
  /// with it they bear the shear that those before bore. origins: of all pieces.
  void follow(const std::vector<PieceOrigin>& origins, std::vector<Position>& slip);
  /// The force on the border, and its moment about the placement's centre; without a name.
  ContactReport report(double t, const double* u) const;
  /// T, of a free body with its d.
  RigidPlacement<N> placement(double t, const double* u) const;
  /// Whether a piece of a patch bears a pressure, (patches).
  std::vector<char> bearing_patches(const RigidPlacement<N>& placement, const double* u) const;

  /// Calls visit(touch) for each piece that bears a pressure.
  template <class Visit>
  void for_closed(const RigidPlacement<N>& placement, const double* u, const Visit& visit) const {
    for_touches(placement, u, 0, [&](const Touch& touch) {
      if (touch.p > 0) visit(touch);
    });
  }

 private:
  void resize();
  void archive_part(const StateArchive& state, const typename ContactSurface<K>::Part& part);
  static constexpr double touching = 1e-6;  // [cells]
  Balance<N> balance(double t, const RigidPlacement<N>& placement, const double* u) const;
  // What acts on a body of an axisymmetric scene across the axis is none, as it cancels around it.
  static Matrix along_axes(Matrix stiffness) {
    if (K == Kinematics::axisymmetric) stiffness.row(0).setZero(), stiffness.col(0).setZero();
    return stiffness;
  }
  bool is_gone(double t, const double* u) const;
  double way_to_touch(const RigidPlacement<N>& placement, const double* u) const;
  /// Calls visit(piece, A S) for each piece that touches, or all but does.
  template <class Visit>
  void for_stiffness(Tangent kind, const RigidPlacement<N>& placement, const double* u, const Visit& visit) const {
    for_touches(placement, u, touching,
                [&](const Touch& touch) { visit(touch.piece, stiffness_of(kind, shear_, touch)); });
  }

  /// Calls visit(touch) for each piece with λ − κ g ≥ −κ slack; slack: in cells.
  template <class Visit>
  void for_touches(const RigidPlacement<N>& placement, const double* u, double slack, const Visit& visit) const;
  void drag(const RigidPlacement<N>& placement, const Touch& touch);
  std::vector<Touch> closed(const RigidPlacement<N>& placement, const double* u) const {
    std::vector<Touch> closed;
    for_closed(placement, u, [&](const Touch& touch) { closed.push_back(touch); });
    return closed;
  }

  const ContactSurface<K>& surface_;
  Finder finder_;
  ShearLimit shear_;
  Position settled_ = Position::Zero();  // d of the last commit, from where the next is looked for [m]
  ContactMultipliers<K> multipliers_;
  // Of the pieces, with friction alone:
  std::vector<Position> anchor_;  // a, in the axes of T⁻¹ x [m]
  std::vector<char> closed_;      // of commit()
  double friction_work_ = 0;
  std::vector<char> was_there_;  // (bodies up to the last that was); empty in the first stage
};

template <Kinematics K, class Finder>
template <class Visit>
void ContactForce<K, Finder>::for_touches(const RigidPlacement<N>& placement, const double* u, double slack,
                                          const Visit& visit) const {
  const auto patches = surface_.patches();
  const auto reach = [&](std::size_t k) {
    const double most = multipliers_.largest_pressure(k);
    return (patches[k].stiffness > 0 ? most / patches[k].stiffness : 0) + slack * patches[k].cell;
  };
  finder_.for_near(placement, u, reach, [&](const typename TouchFinder<K>::Near& near) {
    const double kappa = patches[near.patch].stiffness;
    const double pressure = multipliers_.pressure(near.piece) - kappa * near.at.distance;
    if (!(pressure >= -kappa * slack * patches[near.patch].cell)) return;
    Touch touch{near, surface_.area(near.piece), kappa, std::max(0.0, pressure)};
    if (shear_.acts()) {
      const Position slip = near.X - anchor_[near.piece];
      add_shear<K>(shear_, placement.Q * (multipliers_.shear(near.piece) - kappa * slip), touch);
    }
    visit(touch);
  });
}

}  // namespace stillpoint
