// Why ω₁ is asked for, and with it a factor of K.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>

namespace stillpoint {

struct Omega1Needs {
  bool critical_damping, tolerances, relaxation, distance;
  bool useful;  // it makes an answer better, and costs little
  bool any() const { return critical_damping || tolerances || relaxation || useful; }
};

/// steps_tell: as steps_tell_omega_1() says.
Omega1Needs omega_1_needs(const Problem& problem, std::size_t unknowns, bool steps_tell);

}  // namespace stillpoint
