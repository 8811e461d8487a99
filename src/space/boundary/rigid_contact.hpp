// Contact of bodies with rigid bodies, each of which may touch all pieces of one surface.
//
// The surface has the borders of all bodies that a rigid body of this stage or of a later one may touch, so that it is
// known by then where they are.
#pragma once

#include <string>
#include <vector>

#include "space/boundary/contact_force.hpp"
#include "space/boundary/rigid_faces.hpp"

namespace stillpoint {

template <Kinematics K>
class RigidContact {
  static constexpr int dim = dimensions(K), N = TouchFinder<K>::N;
  using Position = Eigen::Vector<double, N>;

 public:
  using Parts = PhaseParts<dim>;

  /// The problem and first_number, of the points of each body, must outlive this object; grid: that of the first phase;
  /// time_scale: see PrescribedMotion.
  RigidContact(const Problem& problem, const Grid<dim>& grid, const std::vector<int>& first_number, double time_scale);
  RigidContact(const RigidContact&) = delete;  // its parts know where the surface is
  RigidContact& operator=(const RigidContact&) = delete;

  bool empty() const { return bodies_.empty(); }

  /// Throws SceneError if a rigid body overlaps a body, or is inside it, when the first of them appears.
  void begin_phase(const Parts& phase, double t, const StiffnessBound& stiffness_bound);
  /// in_place: see ContactSurface.
  void end_phase(double t, const double* u, bool in_place);
  /// Lets the rigid bodies go a share of their way since the phase began, from then on. True if some have one.
  bool move_on(double share);
  void archive(const StateArchive& state);
  /// Before the first phase of a stage: takes over what the stage before remembers, as archive() saved it.
  void take_over(const StateArchive& state);
  /// Before the first phase: moves borders to where another run has left them.
  void leave_placed(const WaysSincePlaced<dim>& ways);

  /// The number of forces that add_force() writes: those of each rigid body on each patch, component by component.
  std::size_t forces() const { return of_each() * bodies_.size(); }
  /// R −= the forces on the body at (t, u), (n); at_supports: the same at prescribed unknowns; forces: (forces()).
  void add_force(double t, const double* u, Vec R, Vec at_supports, Vec forces) const;
  /// dR += the derivative along du; for the stiffest tangent each piece is held in all directions, whatever touches it.
  void add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const;
  /// Appends the entries of the derivative.
  void add_entries(Tangent kind, double t, const double* u, MatrixEntries& entries) const;
  /// The prescribed displacement of the rigid body at each patch since the phase began, in the order of forces() [m].
  void add_displacements(double t, std::vector<double>& to) const;
  /// The factor by which omega_max² may have grown through contacts since the first phase.
  double growth() const { return surface_.growth(); }

  /// Accepts the state at (t, u): anchors are dragged to where pieces slip.
  void commit(double t, const double* u);
  /// Takes the pressures at (t, u) as multipliers.
  void update_multipliers(double t, const double* u, bool evenly);
  double friction_work() const {
    double work = 0;
    for (const RigidBody& rigid : bodies_) work += rigid.friction_work();
    return work;
  }
  bool is_touched(double t, const double* u) const {
    return std::ranges::any_of(bodies_, [&](const RigidBody& rigid) { return rigid.is_touched(t, u); });
  }
  void add_fit(double t, const double* u, ContactFit& fit) const;
  void add_reports(double t, const double* u, std::vector<ContactReport>& to) const;
  /// What lies in rigid bodies at (t, u), at most one place of a kind for each.
  std::vector<Intrusion> intrusions(const Parts& phase, double t, const double* u) const;
  /// The longest way of a rigid body that is not free since a time before [cells]; beyond `jump` it may have gone
  /// through something.
  static constexpr double jump = 0.5;
  double longest_way(double before, double t) const {
    double longest = 0;
    for (const RigidBody& rigid : bodies_) longest = std::max(longest, way(rigid.finder(), before, t));
    return longest;
  }
  /// What rigid bodies have gone right through since a time before: material points that lie deeper in them on the
  /// straight way between their places than at its ends. Only of those that jump.
  std::vector<Intrusion> passages(const Parts& phase, double before, double t, const double* u) const;
  /// The faces of the rigid bodies at (t, u), at the end of a phase.
  RigidFaces<K> faces(double t, const double* u) const;
  /// Whether a rigid body that is not free is ahead of a body that goes on along a unit vector from (t, u), by the rays
  /// from its border.
  bool is_ahead(std::size_t body, const Point<dim>& direction, double t, const double* u) const;

 private:
  using RigidBody = ContactForce<K, TouchFinder<K>>;

  std::size_t of_each() const { return dim * surface_.patches().size(); }
  static std::string name_of(const RigidBody& rigid);
  /// The way of a rigid body that is not free from one time to another [cells].
  double way(const TouchFinder<K>& finder, double before, double t) const {
    if (finder.is_free() || !finder.moves()) return 0;
    return way_between(finder.placement(before), finder.placement(t)) / least_cell_;
  }
  /// How far a place of a rigid body goes at most from one placement to another, within the grid [m].
  double way_between(const RigidPlacement<N>& from, const RigidPlacement<N>& to) const {
    return (to.u - from.u).norm() + surface_.extent() * (to.Q - from.Q).norm();
  }
  const char* begin() const { return is_later_stage_ ? "the stage begins" : "the run begins"; }
  /// The ways by which pieces that were put between two come to the mean of the gaps of their patches; gaps: of the
  /// patches before, NaN where they bear nothing [m]. origins: of all pieces.
  std::vector<Position> ways_of_new_pieces(const TouchFinder<K>& finder, const RigidPlacement<N>& placement,
                                           const std::vector<double>& gaps,
                                           const std::vector<PieceOrigin>& origins) const;
  void refuse_overlaps(double t) const;
  void refuse_points_inside(const Parts& phase, double t) const;
  /// The material point of a body that it touches which lies deepest in rigid body r; u: null for the start of
  /// the first phase, in which bodies are not looked at that it touched before.
  Intrusion deepest_point(std::size_t r, const RigidPlacement<N>& placement, const Parts& phase, const double* u) const;
  /// The same of the border in patches that bear nothing; bearing: whether they do, (patches).
  Intrusion deepest_border(std::size_t r, const RigidPlacement<N>& placement, const std::vector<char>& bearing,
                           const double* u) const;
  /// The place of its surface where rigid body r lies deepest below the border of a body; border: where its pieces are.
  Intrusion deepest_surface(std::size_t r, const RigidPlacement<N>& placement,
                            const std::vector<BorderPiece<K>>& border) const;
  Intrusion deepest_overlap(std::size_t r, std::size_t other, const std::vector<RigidPlacement<N>>& placements,
                            const Grid<dim>& grid) const;

  const std::vector<int>& first_number_;
  ContactSurface<K> surface_;
  std::vector<RigidBody> bodies_;
  bool has_begun_ = false, is_later_stage_ = false;
  double start_ = 0;       // when the phase began [s]
  double least_cell_ = 0;  // the smallest cell of the surface's patches then [m]
};

}  // namespace stillpoint
