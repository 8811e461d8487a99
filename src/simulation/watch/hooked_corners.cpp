// Rigid bodies that hang by a sharp corner. Contact is felt at the pieces of a border. A corner that has sunk in by
// less than a cell has one piece beside it, which its side pushes along the border: the smooth border of the material
// would not bear that, and a body that should slide would rest behind each piece that it comes to.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

/// A free rigid body that would slide if no corner held it; empty: there is none.
std::string fault_of_corners(const Problem& problem, const LagrangianPhase& phase, double t, ConstVec u) {
  constexpr double little = 1e-3;  // of the force of the body
  const std::vector<ContactReport> reports = phase.supports().contacts(t, u);
  for (std::size_t r = 0; r < problem.rigid.size(); ++r) {
    const auto& [x, y, z] = reports[r].force;
    const double force = std::hypot(x, y, z), hooked = reports[r].hooked;
    if (!problem.rigid[r].free || !(hooked > std::max(little * force, reports[r].friction_left))) continue;
    return fmt::format(
        "{} is held by a sharp corner, which stands behind a place of the border that feels contact: {:.2g} of the "
        "force on it acts along that border, and without it the body slides, as friction does not bear as much; "
        "expected a rounding of half a cell, or smaller cells",
        in_quotes(problem.rigid[r].name), hooked / force);
  }
  return "";
}

class HookedCorners : public Watcher {
 public:
  void confirm(RunState& run, Verdict& verdict) override {
    if (const std::string fault = look(run); !fault.empty())
      verdict = {RunStatus::step_limit, fmt::format("no equilibrium: {}; it ended with {}", fault, verdict.reason)};
  }
  void fill_state(Summary& summary, RunState& run) override {
    if (run.scene.stop.wants_equilibrium()) add_note(summary, look(run));
  }

 private:
  static std::string look(RunState& run) {
    if (std::ranges::none_of(run.scene.rigid, &RigidSpec::free)) return "";
    return fault_of_corners(run.scene, *run.model.phase, run.t, run.motion->u());
  }
};

}  // namespace

std::unique_ptr<Watcher> watch_hooked_corners() { return std::make_unique<HookedCorners>(); }

}  // namespace stillpoint
