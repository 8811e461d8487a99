// What supports report.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace stillpoint {

/// The force that a named support exerts on the body [N]. Of an axisymmetric body its first component is what acts
/// along the radius, summed around the axis. What mass moves with prescribed unknowns is not in it: with that, and in
/// motion, the support bears M a more.
struct SupportReaction {
  std::string name;
  std::array<double, 3> force{};   // its first components are those of the scene [N]
  std::array<double, 3> moment{};  // in space, about the origin, where the supported material is now [N m]
};

/// How far a support that holds by springs gives way.
struct WeakSupport {
  std::size_t support = 0;  // its number in the scene
  std::size_t springs = 0;
  double stiffness = 0;  // at a position [N/m], on a face per area [N/m³]
  double gap = 0;        // the largest |u − u_s| of its springs [m]
};

}  // namespace stillpoint
