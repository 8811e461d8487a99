// Why ω₁ is asked for, and with it a factor of K.
#pragma once

#include <stillpoint/scene.hpp>

#include <cstddef>

namespace stillpoint {

struct Omega1Needs {
  bool critical_damping, tolerances, relaxation, distance;
  bool useful;  // it makes an answer better, and costs little
  bool any() const { return critical_damping || tolerances || relaxation || useful; }
};

/// steps_tell: whether the steps of the relaxation tell omega_1 of the motions that the loads drive.
Omega1Needs omega_1_needs(const Scene& scene, std::size_t unknowns, bool steps_tell);

}  // namespace stillpoint
