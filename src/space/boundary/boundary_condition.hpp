// What holds or loads a body: the one interface of supports, walls, tractions, point forces and body forces.
#pragma once

#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>

#include <vector>

#include "space/boundary/face_gaps.hpp"
#include "space/boundary/prescribed_motion.hpp"
#include "space/boundary/wall_reaction.hpp"
#include "space/grid/degrees_of_freedom.hpp"
#include "space/grid/matrix_entries.hpp"
#include "space/kernels/point_functions.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// The unknowns of a grid (Dim function + component) that boundary conditions take hold of when a phase begins.
class HeldUnknowns {
 public:
  /// Owner of what no support of the scene holds.
  static constexpr std::size_t nobody = static_cast<std::size_t>(-1);

  HeldUnknowns() = default;
  /// t: when the phase begins [s].
  HeldUnknowns(std::size_t unknowns, double t) : start_(t), by_(unknowns, nothing) {}

  /// It follows the motion, which outlives this object, from another place than the grid's if that is `from` [m];
  /// owner: the number of the support in its scene, or nobody.
  void prescribe(int unknown, const PrescribedMotion& motion, std::size_t owner, double from = 0) {
    by_[static_cast<std::size_t>(unknown)] = support;
    prescribed_.push_back(unknown);
    motions_.push_back(&motion);
    owners_.push_back(owner);
    from_.push_back(from);
  }
  /// It stays free, and a wall acts along it.
  void guide(int unknown) {
    if (!is_prescribed(unknown)) by_[static_cast<std::size_t>(unknown)] = wall;
  }
  bool is_prescribed(int unknown) const { return by_[static_cast<std::size_t>(unknown)] == support; }
  bool is_guided(int unknown) const { return by_[static_cast<std::size_t>(unknown)] == wall; }

  /// In the order in which they were prescribed, and how each moves.
  const std::vector<int>& prescribed() const { return prescribed_; }
  const PrescribedMotion& motion(std::size_t s) const { return *motions_[s]; }
  std::size_t owner(std::size_t s) const { return owners_[s]; }
  double start() const { return start_; }  // when the phase begins [s]
  /// Since the phase began; in the first one, from the undeformed body.
  double displacement(std::size_t s, double t) const {
    return motion(s).displacement(t) - (start_ > 0 ? motion(s).displacement(start_) : 0) + from_[s];
  }

 private:
  enum By : char { nothing, support, wall };

  double start_ = 0;
  std::vector<By> by_;  // of each unknown
  std::vector<int> prescribed_;
  std::vector<const PrescribedMotion*> motions_;
  std::vector<std::size_t> owners_;
  std::vector<double> from_;
};

/// What a phase consists of, for its boundary conditions.
template <int Dim>
struct PhaseParts {
  const Grid<Dim>& grid;
  const GridFunctions<Dim>& functions;
  const MaterialPoints<Dim>& points;
  const PointFunctions<Dim>& weights;
  const HeldUnknowns& held;
  const DegreesOfFreedom& dofs;
  const std::vector<double>& node_mass;  // m_i, (functions) [kg]
  const Mass& mass;
  bool remembers;  // whether some of its points have a history
};

/// All boundary conditions of one kind that a scene has. F: (n) [N]; u: over the grid's functions, component i at
/// [Dim function + i] [m].
template <int Dim>
class BoundaryCondition {
 public:
  using Parts = PhaseParts<Dim>;
  using Functions = GridFunctions<Dim>;

  virtual ~BoundaryCondition() = default;

  // A phase begins, in this order:
  /// Takes hold of unknowns. reached: whether material reaches a function, (functions); gaps: how far it is from a face
  /// of the grid. Before the first phase it may be asked twice.
  virtual void hold(const Functions&, const std::vector<char>& /*reached*/, const FaceGaps<Dim>& /*gaps*/,
                    HeldUnknowns&) {}
  /// F += the forces that depend on neither t nor u.
  virtual void begin_phase(const Parts&, Vec /*F*/) {}
  /// v: the velocities with which it begins, changed if they would go through a wall; (n).
  virtual void begin_motion(const Parts&, double /*t*/, Vec /*v*/) {}

  /// Whether add_load() adds what is another force at another t.
  virtual bool varies() const = 0;
  /// F += the forces that depend on t, not on u.
  virtual void add_load(const Parts&, double /*t*/, Vec /*F*/) const {}
  /// Whether some depend on u.
  virtual bool follows() const { return false; }
  /// F += these.
  virtual void add_following_force(const Parts&, double /*t*/, const double* /*u*/, Vec /*F*/) const {}
  /// ∂F/∂u of these.
  virtual void add_following_tangent(const Parts&, double /*t*/, const double* /*u*/, MatrixEntries&) const {}
  /// F_s += all forces at the prescribed degrees of freedom, (prescribed): what supports bear at once. Only where
  /// reactions are looked at.
  virtual void add_load_on_supports(const Parts&, double /*t*/, const double* /*u*/, Vec /*F_s*/) const {}

  /// Whether the phase should end with u, (n), as what it touches lies elsewhere than its weights say.
  virtual bool asks_for_next_phase(ConstVec /*u*/) const { return false; }
  /// The phase ends with u.
  virtual void end_phase(const double* /*u*/) {}

  /// Saves what it remembers of earlier phases and steps, or restores it: once before the phase of then begins anew,
  /// and once more after.
  virtual void archive(const StateArchive& /*state*/) {}

  /// Null if nothing opens and closes; one kind alone may have one.
  virtual Contact* contact() { return nullptr; }
  /// Appends what its walls feel, of the last evaluation.
  virtual void report(double /*t*/, std::vector<WallReaction>& /*to*/) const {}
};

}  // namespace stillpoint
