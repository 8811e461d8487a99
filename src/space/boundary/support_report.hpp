// Reports of supports.
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

}  // namespace stillpoint
