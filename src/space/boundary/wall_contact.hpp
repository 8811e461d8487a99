// Rigid walls along faces of the grid: they take no tension, with Coulomb friction.
//
// A wall acts at the grid functions that alone are not zero on its face. Each of its nodes is open or closed. The set
// changes only between accepted steps, so that within a step the motion stays a smooth ODE; the forces follow from it.
// With the out-of-balance force Q, the wall's displacement u_w and velocity w, s = ±1 outwards, and the gap g between
// the node's material and the wall when the phase began (FaceGaps):
//
//   open     F = 0                             closes when its material touches: s (u_n − u_w) ≥ g, then u_n = u_w + s
//   g closed   a_n = w',                         opens if s F_n > 0, tension
//            F_n = m (w' + c w) − Q_n,
//            F_t = −S min(1, μ |F_n|/|S|),     S = Q_t + (m/h − c m/2) v_t would come to rest within the step h
//
// t: along the face, one component in the plane and two in space; v_t: at the end of the last step. So friction goes
// against the way that a node slides at the end of the step, and holds it where it stops it until then [Moreau 1988].
// Against the way at its beginning it would turn round ever again where a body slides slowly, and bear less than μ
// |F_n| in the mean. w and w' of a closed node are differences over the last step's length: a wall that stops or starts
// at once does so within a step, wherever in it that falls. What has gone past the wall within a step, or lies inside
// it, is put back onto it: where a body comes to rest does not depend on how it came there.
//
// Where g > 0 there is a layer without material between the wall and what it touches, whose functions resist too
// little. So a phase should end when a node has closed across more than a thousandth of a cell: the next one begins
// where the material touches the wall.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/types.hpp>

#include <array>
#include <string>
#include <vector>

#include "space/boundary/wall_motion.hpp"
#include "space/boundary/wall_reaction.hpp"

namespace stillpoint {

class WallContact {
 public:
  /// friction: μ, infinite for a rough wall. upper: the wall is on the side of larger coordinates.
  WallContact(std::string name, bool upper, double friction, WallMotion motion);

  /// A phase begins at t: the nodes in order along the face, by the free degrees of freedom of their components, −1
  /// if it is not free. What was closed stays so.
  struct Node {
    int normal = -1;
    std::array<int, 2> along{-1, -1};
    double gap = 0;  // g [m]; of a node whose gap() is not asked for it does not matter
  };
  struct Phase {
    double t = 0;                         // when it begins [s]
    double face_at = 0;                   // how far the face of the grid has moved [m]
    double cell = 0;                      // the width of the cells there [m]
    double most = WallMotion::unlimited;  // how far the wall may go within a step [m]
    bool remembers = false;  // whether the body has a history, which a jump of a node would leave its mark in
  };
  /// mass: diagonal of the lumped M, which outlives the phase, (n).
  void begin_phase(const Phase& phase, ConstVec mass, std::vector<Node> nodes, Vec v);
  /// Whether node k was closed where its material touches: its gap is 0.
  bool stays(std::size_t k) const { return started_ && k < closed_.size() && closed_[k] && gap_[k] == 0; }

  /// Q += contact forces, for C = c_m M + c_i I; Q: (n). A pure function of what is closed.
  void add_force(double t, const LinearDamping& C, Vec Q) const;
  /// Q of the closed nodes' normals as the last add_force() left it.
  void hold(Vec Q) const;
  /// Opens and closes nodes after an accepted step at t; the last add_force() was there. What of u and v it changes.
  ContactChange update(double t, Vec u, Vec v);
  /// Whether a node has closed across a gap that weights see, or the wall has gone far by itself: what it may come to
  /// next is known when a phase begins.
  bool asks_for_next_phase() const;
  bool is_settled() const { return !motion_.is_late(); }
  /// What the body does to it, of the last add_force(), and where it is, t being that of the last step.
  WallReaction reaction(double t) const;
  void archive(const StateArchive& state);
  /// Σ F² over the nodes, of the same.
  double square_of_forces() const;

 private:
  using Along = std::array<double, 2>;  // of each component along the face

  /// Of v or Q at a node; 0 where it is not free.
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
  double cell_ = 0;      // of the phase [m]
  double put_back_ = 0;  // the furthest that a node has been put back onto the wall [m]
  // When the run begins, every node is taken for closed until the first forces show which ones the wall would have to
  // pull: a body that leans on a wall does so from the start, also on one that begins to give way.
  bool started_ = false;
  double start_ = 0;                          // the displacement of the face that the phase's positions go by [m]
  mutable std::vector<double> held_;          // m (w' + c w) of closed nodes at the last add_force()
  mutable std::vector<double> normal_force_;  // F_n and F_t on the body's nodes, likewise
  mutable std::vector<Along> shear_force_;
  mutable std::vector<char> brakes_;  // whether F_t brings a node to rest, likewise
};

}  // namespace stillpoint
