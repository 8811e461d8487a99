// Rigid walls along faces of the grid: unilateral contact with Coulomb friction.
//
// A wall acts at the grid functions that alone do not vanish on its face. Each of its nodes is open or closed. The set
// of closed nodes changes only between accepted steps, so that within a step the motion stays a smooth ODE; the forces
// follow from the set. With the out-of-balance force Q, the wall's displacement u_w and velocity w, s = ±1 outwards,
// and the gap g between the node's material and the wall when the phase began (FaceGaps):
//
//   open     F = 0                             closes when its material touches, s (u_n − u_w) ≥ g: u_n = u_w + s g
//   closed   a_n = w',                         opens if s F_n > 0, tension
//            F_n = m (w' + c w) − Q_n,
//            F_t = −S min(1, μ |F_n|/|S|),     S = Q_t + (m/h − c m/2) v_t would come to rest within the step h
//
// t: along the face, one component in the plane and two in space; v_t: at the end of the last step. Friction thus
// opposes the sliding at the end of the step, and holds a node that it stops within the step [Moreau 1988]. Friction
// against the sliding at the beginning of the step would reverse again and again where a body slides slowly, and bear
// less than μ |F_n| in the mean. w and w' of a closed node are differences over the last step's length: a wall that
// stops or starts suddenly does so within one step, at whatever time in it. A node that has moved past the wall within
// a step, or lies inside it, is put back onto it, so that the position of rest does not depend on the path to it.
//
// Where g > 0 there is a layer without material between the wall and the material in contact, and the functions of that
// layer resist too little. A phase should therefore end when a node has closed across more than a thousandth of a cell:
// the next one begins where the material touches the wall.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/types.hpp>

#include <array>
#include <string>
#include <vector>

#include "space/boundary/condition_reports.hpp"
#include "space/boundary/wall_motion.hpp"

namespace stillpoint {

class WallContact {
 public:
  /// friction: μ, infinite for a rough wall. upper: the wall is on the side of larger coordinates.
  WallContact(std::string name, bool upper, double friction, WallMotion motion);

  /// A node of the wall; nodes are in order along the face, and name the free degrees of freedom of their components,
  /// −1 if a component is not free.
  struct Node {
    int normal = -1;
    std::array<int, 2> along{-1, -1};
    double gap = 0;  // g [m]; unused for a node that stays()
  };
  struct Phase {
    double t = 0;                         // when it begins [s]
    double face_at = 0;                   // displacement of the face of the grid since the start [m]
    double cell = 0;                      // width of the cells at the face [m]
    double most = WallMotion::unlimited;  // largest displacement of the wall within a step [m]
    bool remembers = false;  // whether the body has a history, in which a jump of a node would leave a trace
  };
  /// Begins a phase; nodes that were closed stay closed. mass: diagonal of the lumped M, which must outlive the phase,
  /// (n); v: initial velocities, changed at nodes that close.
  void begin_phase(const Phase& phase, ConstVec mass, std::vector<Node> nodes, Vec v);
  static constexpr std::size_t is_new = static_cast<std::size_t>(-1);
  /// Before a phase begins: its node k was node from[k] of the last one, or is_new.
  void take_nodes(const std::vector<std::size_t>& from);
  /// Whether node k was closed in contact with its material, at gap 0, and stays closed.
  bool stays(std::size_t k) const { return started_ && k < closed_.size() && closed_[k] && gap_[k] == 0; }

  /// Q += contact forces, for C = c_m M + c_i I; Q: (n). It depends on the closed nodes only.
  void add_force(double t, const LinearDamping& C, Vec Q) const;
  /// Sets Q at the normals of the closed nodes as the last add_force() did.
  void hold(Vec Q) const;
  /// Opens and closes nodes after an accepted step to t, at which the last add_force() was. Returns what it changed in
  /// u and v.
  ContactChange update(double t, Vec u, Vec v);
  /// Whether a node has closed across a gap that the weights resolve, or the wall has moved far without contact: the
  /// nodes that it may touch next are known only when a phase begins.
  bool asks_for_next_phase() const;
  bool is_settled() const { return !motion_.is_late(); }
  /// The forces of the body on the wall in the last add_force(), and the wall's position; t: the time of the last step.
  WallReaction reaction(double t) const;
  void archive(const StateArchive& state);
  /// Σ F² over the nodes, from the last add_force().
  double square_of_forces() const;

 private:
  using Along = std::array<double, 2>;  // the components along the face

  /// The tangential part of v or Q at a node; 0 where a component is not free.
  Along along(std::size_t k, ConstVec values) const;
  bool stop_along(std::size_t k, Vec v);
  bool slide(std::size_t k, Vec v);
  bool approaches(std::size_t k, double velocity, ConstVec v) const;
  bool close(std::size_t k, double velocity, Vec v);
  double touches_at(std::size_t k, double wall) const { return wall + outward_ * gap_[k]; }

  std::string name_;
  double outward_, friction_;
  WallMotion motion_;
  ConstVec mass_;
  std::vector<Node> nodes_;
  std::vector<int> closed_;     // 1 or 0
  std::vector<Along> sliding_;  // v_t of closed nodes at the end of the last step [m/s]
  std::vector<double> gap_;     // g [m]
  bool closed_across_gap_ = false;
  double cell_ = 0;      // width of a cell in the phase [m]
  double put_back_ = 0;  // the largest distance by which a node has been put back onto the wall [m]
  // When the run begins, every node is treated as closed until the first forces show which nodes the wall would have to
  // pull: a body that leans on a wall does so from the start, also on a wall that begins to give way.
  bool started_ = false;
  double start_ = 0;                          // displacement of the grid's face at the start of the phase [m]
  mutable std::vector<double> held_;          // m (w' + c w) of closed nodes at the last add_force()
  mutable std::vector<double> normal_force_;  // F_n on the body's nodes at the last add_force(); below F_t
  mutable std::vector<Along> shear_force_;
  mutable std::vector<char> brakes_;  // whether F_t brings a node to rest
};

}  // namespace stillpoint
