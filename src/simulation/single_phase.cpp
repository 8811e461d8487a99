#include "simulation/single_phase.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace stillpoint {

std::optional<SinglePhaseStrain> strain_in_single_phase(const LagrangianPhase& phase, double t, ConstVec u) {
  if (phase.info().updated_lagrangian || !phase.history_dependent()) return std::nullopt;
  const auto components = static_cast<std::size_t>(phase.info().gradient_components);
  std::vector<double> gradient(components * phase.points());
  phase.fields().point_strain(t, u, gradient);
  SinglePhaseStrain most;
  for (std::size_t k = 0; k < gradient.size(); ++k)
    if (std::abs(gradient[k]) > most.strain) most = {std::abs(gradient[k]), k / components};
  return most;
}

std::string note_on_single_phase(std::optional<double> strain) {
  constexpr double small = 0.1;
  if (!(strain.value_or(0) > small)) return "";
  return fmt::format(
      "a material that yields is strained by {:.0f} % in a single phase: the grid of the start, squeezed so far, bears "
      "loads that the material may not; expected a smaller load, or phases that end (phase.max_motion = 0.1)",
      100 * *strain);
}

}  // namespace stillpoint
