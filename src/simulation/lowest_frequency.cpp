#include "simulation/lowest_frequency.hpp"

#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "simulation/mechanism.hpp"
#include "simulation/notes.hpp"

namespace stillpoint {

void find_omega_1(const Problem& problem, const Omega1Needs& needs, SetUp& set_up, Model& model) {
  const FrequencyEstimate lowest =
      set_up.shared(part_omega_1, model.mass, [&] { return omega_1_by_lanczos(*model.phase, 0, model.u); });
  if (lowest.converged) {
    model.omega_1 = lowest.omega;
    const bool physical_mass = !(model.relaxation && model.relaxation->chooses_mass);
    if (physical_mass && problem.mass.scaling == MassScaling::uniform)
      std::ranges::move(lowest_mode_notes(problem, *model.phase, lowest.mode, lowest.omega),
                        std::back_inserter(model.notes));
    return;
  }
  refuse_mechanism(problem, *model.phase, model.u);
  if (needs.distance) {
    throw_scene_error(
        "stop.distance",
        fmt::format("a distance is bounded by omega_1, but {}; expected a support, or stop.residual", lowest.status));
  }
  if (needs.relaxation) {
    throw_scene_error(
        "damping.strategy",
        fmt::format("'{}' needs omega_1, but {}; expected a support, more points per cell, or another strategy",
                    model.relaxation->about.name, lowest.status));
  }
  if (needs.critical_damping) {
    throw_scene_error(
        "damping.c",
        fmt::format("critical damping needs omega_1, but {}; expected a support, more points per cell, or a number",
                    lowest.status));
  }
  model.notes.push_back(
      fmt::format("omega_1 is not known ({}): equilibrium is held for 100 of the shortest periods", lowest.status));
}

}  // namespace stillpoint
