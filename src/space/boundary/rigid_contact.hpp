// Contact of bodies with rigid bodies: a force in R(u), exact when open.
//
// At a piece s of a body's border (ContactSurface) with the area A and the position x(u), under a rigid body with the
// signed distance φ, placed by T(t):
//
//   g = φ(T⁻¹ x),   p = max(0, λ − κ g),   f = A (p n + τ),   R −= w f,   n = ∇φ
//
// κ: the stiffness of its patch; λ: the multiplier of the patch, the pressure that needs no penetration. Without
// friction R has the potential Σ A p²/(2 κ), and its tangent is symmetric,
//
//   ∂f/∂x = −A (κ n nᵀ − p ∇n).
//
// A penalty alone gives way by p/κ. The augmented Lagrangian [Simo and Laursen 1992] takes that back: in equilibrium λ
// becomes the mean p of the patch, and the body goes on to where the mean g is 0. A multiplier for each piece would
// drift, since the grid's functions cannot tell the pieces of a patch apart.
//
// Friction [Coulomb]: with the anchor a, the position in the rigid body at which the piece stuck last, the elastic slip
// s = (I − n nᵀ)(T⁻¹ x − a) and the multiplier λ_t,
//
//   τ = clip(λ_t − κ s) to |τ| ≤ μ p,   a rough body: no limit.
//
// Where it slips, the anchor is dragged along when a step is accepted, so that κ s = λ_t − τ there: R depends on the
// committed state, and has no potential.
#pragma once

#include <algorithm>
#include <vector>

#include "space/boundary/condition_reports.hpp"
#include "space/boundary/contact_surface.hpp"
#include "space/boundary/touch_finder.hpp"

namespace stillpoint {

template <Kinematics K>
class RigidContact {
  static constexpr int dim = dimensions(K), N = TouchFinder<K>::N;
  using Position = Eigen::Vector<double, N>;
  using Matrix = Eigen::Matrix<double, N, N>;

 public:
  using Parts = PhaseParts<dim>;

  /// The problem must outlive this object; grid: that of the first phase; time_scale: see PrescribedMotion.
  RigidContact(const Problem& problem, const Grid<dim>& grid, double time_scale);
  RigidContact(const RigidContact&) = delete;  // its parts know where the surface is
  RigidContact& operator=(const RigidContact&) = delete;

  bool empty() const { return bodies_.empty(); }
  /// Whether R depends on the state at the last commit.
  bool remembers() const { return remembers_; }

  /// Throws SceneError if a rigid body overlaps a body when the run begins.
  void begin_phase(const Parts& phase, double t, const StiffnessBound& stiffness_bound);
  void end_phase(const double* u) { surface_.end_phase(u); }
  void archive(const StateArchive& state);

  /// The number of forces that add_force() writes: those of each rigid body on each patch, component by component.
  std::size_t forces() const { return dim * surface_.patches().size() * bodies_.size(); }
  /// R −= the forces on the body at (t, u), (n); at_supports: the same at prescribed unknowns; forces: (forces()).
  void add_force(double t, const double* u, Vec R, Vec at_supports, Vec forces) const;
  /// dR += the derivative along du.
  void add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const;
  /// matrix += the derivative.
  void add_matrix(Tangent kind, double t, const double* u, SparseMatrix& matrix) const;
  /// The displacement of the rigid body at each patch since the phase began, in the order of forces() [m].
  void add_displacements(double t, std::vector<double>& to) const;
  /// The factor by which omega_max² may have grown through contacts since the first phase.
  double growth() const { return growth_; }

  /// Accepts the state at (t, u): anchors are dragged to where pieces slip.
  void commit(double t, const double* u);
  /// Takes the pressures at (t, u) as multipliers.
  void update_multipliers(double t, const double* u);
  ContactState state(double t, const double* u) const;
  std::vector<RigidReport> report(double t, const double* u) const;

 private:
  struct RigidBody {
    TouchFinder<K> finder;
    double friction;
    // Of the patches:
    std::vector<double> lambda;      // λ [Pa]
    std::vector<Position> lambda_t;  // λ_t, in the rigid body's axes [Pa]
    // Of the pieces, with friction:
    std::vector<Position> anchor;  // a, in the rigid body's axes [m]
    std::vector<char> closed;      // of commit()
  };
  /// What touches at a piece.
  struct Touch : TouchFinder<K>::Near {
    double area, kappa;
    double p;            // [Pa]
    Position tau;        // τ, in the scene's axes [Pa]
    Position tau_trial;  // λ_t − κ s before the limit, likewise
    bool slips;
  };

  /// Calls visit(touch) for each piece with λ − κ g ≥ −κ slack; slack: in cells.
  template <class Visit>
  void for_touches(const RigidBody& rigid, const RigidPlacement<N>& placement, const double* u, double slack,
                   const Visit& visit) const;
  /// The same for those that exert a pressure.
  template <class Visit>
  void for_closed(const RigidBody& rigid, const RigidPlacement<N>& placement, const double* u,
                  const Visit& visit) const {
    for_touches(rigid, placement, u, 0, [&](const Touch& touch) {
      if (touch.p > 0) visit(touch);
    });
  }
  void add_friction(const RigidBody& rigid, const RigidPlacement<N>& placement, Touch& touch) const;
  Matrix stiffness(const RigidBody& rigid, Tangent kind, const Touch& touch) const;
  template <class Visit>
  void for_stiffness(Tangent kind, double t, const double* u, const Visit& visit) const;
  void drag(RigidBody& rigid, const RigidPlacement<N>& placement, const Touch& touch) const;
  void refuse_overlaps(double t) const;

  ContactSurface<K> surface_;
  std::vector<RigidBody> bodies_;
  bool remembers_ = false, has_begun_ = false;
  double start_ = 0;  // when the phase began [s]
  double first_bound_ = 0, growth_ = 1;
};

template <Kinematics K>
template <class Visit>
void RigidContact<K>::for_touches(const RigidBody& rigid, const RigidPlacement<N>& placement, const double* u,
                                  double slack, const Visit& visit) const {
  const auto patches = surface_.patches();
  const auto reach = [&](std::size_t k) {
    return (patches[k].stiffness > 0 ? rigid.lambda[k] / patches[k].stiffness : 0) + slack * patches[k].cell;
  };
  rigid.finder.for_near(placement, u, reach, [&](const typename TouchFinder<K>::Near& near) {
    const double kappa = patches[near.patch].stiffness;
    Touch touch{near,
                surface_.area(near.piece),
                kappa,
                std::max(0.0, rigid.lambda[near.patch] - kappa * near.at.distance),
                Position::Zero(),
                Position::Zero(),
                false};
    if (rigid.friction > 0) add_friction(rigid, placement, touch);
    visit(touch);
  });
}

}  // namespace stillpoint
