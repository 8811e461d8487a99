// The one interface of supports, walls, tractions, point forces and body forces.
#pragma once

#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

#include "space/boundary/condition_reports.hpp"
#include "space/boundary/face_gaps.hpp"
#include "space/boundary/prescribed_motion.hpp"
#include "space/boundary/way_since_placed.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/matrix_entries.hpp"
#include "space/kernels/point_functions.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// The unknowns of a grid (Dim function + component) that boundary conditions prescribe or guide when a phase begins.
class HeldUnknowns {
 public:
  /// The owner of unknowns that no support of the scene holds.
  static constexpr std::size_t nobody = static_cast<std::size_t>(-1);

  HeldUnknowns() = default;
  /// t: when the phase begins [s].
  HeldUnknowns(std::size_t unknowns, double t) : start_(t), by_(unknowns, nothing) {}

  /// Prescribes an unknown. It follows the motion, which must outlive this object, starting from the displacement
  /// `from` [m] relative to the grid; owner: the number of the support in its scene, or nobody.
  void prescribe(int unknown, const PrescribedMotion& motion, std::size_t owner, double from = 0) {
    by_[static_cast<std::size_t>(unknown)] = support;
    if (motion.moves() || motion.displacement(0) != 0 || from != 0) displaced_.push_back(prescribed_.size());
    prescribed_.push_back(unknown);
    motions_.push_back(&motion);
    owners_.push_back(owner);
    from_.push_back(from);
  }
  /// Holds an unknown where it is, for the phase; everything else that holds unknowns comes first.
  void let_rest(int unknown) {
    static const PrescribedMotion none(Expression(0.0), 1.0);
    prescribe(unknown, none, nobody);
    ++at_rest_;
  }
  /// The first of the prescribed unknowns that rest; all after it do.
  std::size_t first_at_rest() const { return prescribed_.size() - at_rest_; }
  /// Marks an unknown along which a wall acts; it stays free.
  void guide(int unknown) {
    if (!is_prescribed(unknown)) by_[static_cast<std::size_t>(unknown)] = wall;
  }
  bool is_prescribed(int unknown) const { return by_[static_cast<std::size_t>(unknown)] == support; }
  bool is_guided(int unknown) const { return by_[static_cast<std::size_t>(unknown)] == wall; }

  /// The prescribed unknowns in the order in which they were prescribed, and the motion and owner of each.
  const std::vector<int>& prescribed() const { return prescribed_; }
  const PrescribedMotion& motion(std::size_t s) const { return *motions_[s]; }
  /// The prescribed unknowns whose displacement is not 0 at all times, by their numbers s.
  const std::vector<std::size_t>& displaced() const { return displaced_; }
  std::size_t owner(std::size_t s) const { return owners_[s]; }
  /// The displacement of prescribed unknown s relative to the grid with which the phase begins, without a strain.
  double from(std::size_t s) const { return from_[s]; }
  double start() const { return start_; }  // when the phase begins [s]
  /// Displacement of prescribed unknown s since the phase began; in the first phase, from the undeformed body.
  double displacement(std::size_t s, double t) const {
    const double way = motion(s).displacement(t) - (start_ > 0 ? motion(s).displacement(start_) : 0);
    return share_ * way + from_[s];
  }
  /// Lets all prescribed unknowns go a share of that way. True if some have one.
  bool move_on(double share) {
    share_ = share;
    return std::ranges::any_of(
        motions_, [](const PrescribedMotion* motion) { return motion->moves() || motion->displacement(0) != 0; });
  }

 private:
  enum By : char { nothing, support, wall };

  double start_ = 0, share_ = 1;
  std::vector<By> by_;  // the condition on each unknown
  std::vector<int> prescribed_;
  std::size_t at_rest_ = 0;  // the number of those that rest
  std::vector<std::size_t> displaced_;
  std::vector<const PrescribedMotion*> motions_;
  std::vector<std::size_t> owners_;
  std::vector<double> from_;
};

class CornerSum;  // corner_sum.hpp

/// The parts of a phase that its boundary conditions use.
template <int Dim>
struct PhaseParts {
  const Grid<Dim>& grid;
  const GridFunctions<Dim>& functions;
  const MaterialPoints<Dim>& points;
  const PointFunctions<Dim>& weights;
  const CornerSum& corner_sum;
  const HeldUnknowns& held;
  const DegreesOfFreedom& dofs;
  const std::vector<double>& node_mass;  // m_i, (functions) [kg]
  const Mass& mass;
  bool remembers;                   // whether some of the points have a history
  bool is_of_small_strain;          // whether all laws are
  const std::vector<double>& gone;  // see PhaseFrame

  /// Where point p is when the phase begins.
  Point<Dim> place_of(std::size_t p) const {
    Point<Dim> x = points.position(p);
    const std::size_t first = static_cast<std::size_t>(Dim) * static_cast<std::size_t>(points.number[p]);
    for (std::size_t d = 0; d < Dim && !gone.empty(); ++d) x[d] += gone[first + d];
    return x;
  }
};

/// All boundary conditions of one kind in a scene. F: (n) [N]; u: over the grid's functions, component i at [Dim
/// function + i] [m].
template <int Dim>
class BoundaryCondition {
 public:
  using Parts = PhaseParts<Dim>;
  using Functions = GridFunctions<Dim>;

  virtual ~BoundaryCondition() = default;

  /// The kind, by which the next stage finds what this one remembers.
  virtual std::string_view kind() const = 0;

  // Called when a phase begins, in this order:
  /// Marks the unknowns that are held. reached: whether material reaches a function, (functions); gaps: the distance of
  /// the material from the faces of the grid. May be called twice before the first phase.
  virtual void hold(const Functions&, const std::vector<char>& /*reached*/, const FaceGaps<Dim>& /*gaps*/,
                    HeldUnknowns&) {}
  /// F += the forces that depend on neither t nor u.
  virtual void begin_phase(const Parts&, Vec /*F*/) {}
  /// Changes initial velocities of the phase that would go through a wall; v: (n).
  virtual void begin_motion(const Parts&, double /*t*/, Vec /*v*/) {}

  /// Called before the next phase begins if the functions have other numbers there: now_of[f] is that of the former
  /// function f, −1 if it has none, in the same order; functions: how many there are.
  virtual void renumber(const std::vector<int>& /*now_of*/, int /*functions*/) {}

  /// Whether the force that add_load() adds depends on t.
  virtual bool varies() const = 0;
  /// F += the forces that depend on t, not on u.
  virtual void add_load(const Parts&, double /*t*/, Vec /*F*/) const {}
  /// Whether some forces depend on u.
  virtual bool follows() const { return false; }
  /// F += the forces that depend on u.
  virtual void add_following_force(const Parts&, double /*t*/, const double* /*u*/, Vec /*F*/) const {}
  /// Adds ∂F/∂u of the forces that depend on u.
  virtual void add_following_tangent(const Parts&, double /*t*/, const double* /*u*/, MatrixEntries&) const {}
  /// F_s += all forces at the prescribed degrees of freedom, (prescribed), which supports bear directly. Needed only
  /// where reactions are reported.
  virtual void add_load_on_supports(const Parts&, double /*t*/, const double* /*u*/, Vec /*F_s*/) const {}

  /// Whether the phase should end with u, (n), as the material that the condition acts on is no longer where its
  /// weights say.
  virtual bool asks_for_next_phase(ConstVec /*u*/) const { return false; }
  /// Called when the phase ends with u.
  virtual void end_phase(const double* /*u*/) {}

  /// Called before the first phase of a later stage: restores what archive() saved at the end of the stage before, of
  /// as much as goes on.
  virtual void take_over(const StateArchive& state) { archive(state); }
  /// Called after that, or before the first phase of a run that begins with the points of another one: moves what
  /// begins now to where its material is.
  virtual void leave_placed(const WaysSincePlaced<Dim>&) {}

  /// Saves or restores what the condition remembers of earlier phases and steps; a restoration calls it twice, before
  /// and after the saved phase begins anew.
  virtual void archive(const StateArchive& /*state*/) {}

  /// The contact of this kind; null if nothing opens and closes. At most one kind may have one.
  virtual Contact* contact() { return nullptr; }
  /// Appends the forces on the walls, from the last evaluation.
  virtual void report(double /*t*/, std::vector<WallReaction>& /*to*/) const {}
};

}  // namespace stillpoint
