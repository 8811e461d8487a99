// A scene stepped from phase to phase, to be looked at before and after each change.
#pragma once

#include <stillpoint/stillpoint.hpp>

#include <functional>
#include <string>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint::test {

/// The state when a phase ends, or when the next has begun.
struct Moment {
  double t;
  const LagrangianPhase& phase;
  ConstVec u, v;
};
/// Steps a scene until t_end. at_change(moment, after): before and after each change of phase.
inline Simulation advanced(const Scene& scene, double t_end,
                           const std::function<void(const Moment&, bool after)>& at_change = {}) {
  const Simulation* self = nullptr;
  const auto tell = [&](bool after) {
    if (at_change) at_change({self->t(), self->parts().phase, self->u(), self->v()}, after);
  };
  Simulation simulation(scene, {.records = false, .stops = false, .at_phase_change = tell});
  self = &simulation;
  REQUIRE(simulation.run_until(t_end) == RunStatus::running);
  return simulation;
}

inline Scene wall_on(const std::string& face, const std::string& motion = "t") {
  return free_block({"wall=[{name='gate', face='" + face + "', motion='" + motion + "'}]", "grid.follow=gate"});
}

}  // namespace stillpoint::test
