// Reports of supports, walls and driven loads.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace stillpoint {

/// The force that a named support exerts on the body [N]. In an axisymmetric body the first component is the radial
/// force, summed around the axis. The inertia of the mass that moves with prescribed unknowns is not included: while
/// that moves, the support bears M a more.
struct SupportReaction {
  std::string name;
  std::array<double, 3> force{};   // components along the scene's axes [N]
  std::array<double, 3> moment{};  // in space, about the origin, at the present position of the supported material [N
                                   // m]
};

/// The displacement of an elastic support.
struct WeakSupport {
  std::size_t support = 0;  // its number in the scene
  std::size_t springs = 0;
  double stiffness = 0;  // at a position [N/m], on a face per area [N/m³]
  double gap = 0;        // the largest |u − u_s| of its springs [m]
};

/// The force of the body on a rigid wall [N]: along the wall's outward normal, and along the other axes in order, one
/// in the plane and two in space.
struct WallReaction {
  std::string name;
  int axis = 0;  // axis of the normal
  double normal = 0;
  std::array<double, 2> shear{};
  double power = 0;            // power of the wall on the body [W]
  double displacement = 0;     // displacement of the wall [m]
  double furthest_behind = 0;  // largest distance so far behind the prescribed motion [m]
  double put_back = 0;         // largest distance so far by which a node has been put back onto the wall [m]
};

/// What a rigid body exerts on the bodies that it touches, or the second body of a contact on the first.
struct ContactReport {
  std::string name;
  std::array<double, 3> force{};   // components along the scene's axes, summed around the axis if axisymmetric [N]
  std::array<double, 3> moment{};  // about RigidSpec::about, which moves with it, and of a contact about the origin; in
                                   // the plane the third alone [N m]
  std::array<double, 3> displacement{};  // of a free rigid body, since the run began [m]
  double area = 0;                       // where it touches [m²]
  double few = 0;                        // the pieces that bear, if they are few amid a border (pushed_pieces.hpp)
  double penetration = 0;                // the largest [cells]
  double held = 0;                       // the same where supports hold the border against it
  double slipping = 0;                   // share of that area which slips
  double slid = 0;                       // how far bodies have moved along each other in the phase, where most [cells]
  std::array<double, 3> strayed{};  // the part of the force along normals of what was opposite when the phase began
                                    // and is opposite no more [N]
  double turned = 0;   // by how much a piece that touches has turned on what it touches in the phase, where most [rad]
  double stretch = 1;  // by which a piece of the border that touches is drawn out, where most, if it is not cut anew
  // At a sharp corner a piece may be pushed along its own border, by the side of the rigid body that it is behind:
  double hooked = 0;      // the pressures there, as a force along the border [N]
  double across = 0;      // of a free rigid body that few pieces bear: what these do not bear along the normals of
                          // their border (force_across.hpp) [N]
  double shear_left = 0;  // that could bear either in their place [N]
  bool is_gone = false;   // a free rigid body that has found nothing on its way, far beyond all that it may touch
};

/// What lies in a rigid body without being felt, where it lies deepest.
struct Intrusion {
  enum class Of { points, border, surface, rigid, bodies, way };
  Of of = Of::points;  // of material points; of the border beside the pieces that feel contact, where these bear
                       // nothing; of the surface of the rigid body in the body; of a rigid body; of bodies in each
                       // other; or of material points on the way of the rigid body
  std::size_t rigid = 0, other = 0;  // numbers in the scene, of the rigid body and of the body or rigid body in it; of
                                     // bodies in each other, of their contact
  double cells = 0;                  // the depth [cells]
  bool bears = false;                // whether anything presses on the rigid body
  std::vector<double> at{};          // [m]

  /// Takes another place if it is deeper. x: its position.
  template <std::size_t Dim>
  void take(double depth, std::size_t in, const std::array<double, Dim>& x) {
    if (!(depth > cells)) return;
    cells = depth;
    other = in;
    at.assign(x.begin(), x.end());
  }
};

/// Contact with rigid bodies, and of bodies with each other.
struct ContactState {
  bool touches = false;  // whether anything touches
  bool balanced = true;  // whether each free rigid body is where its forces balance
  double misfit = 0;     // the largest penetration, or gap, that can be told [cells]
  double change = 0;  // by which its pressures would change the multipliers, as a share of what unknowns feel of them
};

/// The state of loads that a displacement drives (load_control.hpp).
struct LoadState {
  double factor = 0;        // λ of the reference loads
  double displacement = 0;  // q, their mean displacement [m]
  double prescribed = 0;    // the prescribed q(t) [m]
};

}  // namespace stillpoint
