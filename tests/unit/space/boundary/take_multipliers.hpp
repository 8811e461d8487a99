// The pressures of contact taken as multipliers, each patch by itself, in an evaluation that follows.
#pragma once

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint::test {

/// Takes them at (0, u), u: (n). Checks that an evaluation of before becomes one with the new multipliers. size: of the
/// forces [N].
inline void take_multipliers(LagrangianPhase& phase, const std::vector<double>& u, double size) {
  std::vector<double> R(phase.size()), anew(phase.size());
  const auto trial = phase.make_trial(), trial_anew = phase.make_trial();
  REQUIRE(phase.internal_force(0, u, R, *trial));
  const std::vector<double> before = R;
  phase.control().update_multipliers(0, u, /*evenly=*/false, R, *trial);
  CHECK(R != before);
  REQUIRE(phase.internal_force(0, u, anew, *trial_anew));
  const double rounding = 1e-12 * std::abs(size);
  for (std::size_t k = 0; k < R.size(); ++k) CHECK(R[k] == Approx(anew[k]).margin(rounding));
  REQUIRE(trial->reactions.size() == trial_anew->reactions.size());
  for (std::size_t k = 0; k < trial->reactions.size(); ++k)
    CHECK(trial->reactions[k] == Approx(trial_anew->reactions[k]).margin(rounding));
}

}  // namespace stillpoint::test
