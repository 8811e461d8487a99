// A body that yields in a single phase, whose grid and weights are those of its start: beyond its limit load no
// equilibrium is left, and the residual ends at the share of the load that it does not bear; but the frozen grid
// stiffens as it is squeezed, and bears any load in the end. So the strain tells how far the answer can be trusted. A
// hyperelastic body is computed rightly at any strain in one phase.
#include <fmt/format.h>

#include "output/point_fields.hpp"
#include "simulation/watcher.hpp"

namespace stillpoint {
namespace {

// Beyond this strain a run of one phase ends in no equilibrium: the material has gone nearly as far as its own size,
// which twice the load that it bears takes it to.
constexpr double largest_single_phase_strain = 0.9;

// The strain at (t, u); empty if the points move on, or nothing remembers its path.
std::optional<LargestStrain> strain_in_single_phase(const LagrangianPhase& phase, double t, ConstVec u) {
  if (phase.info().updated_lagrangian || !phase.info().remembers) return std::nullopt;
  return largest_strain(phase, t, u);
}

// A note on the strain; empty: there is nothing to say.
std::string note_on_single_phase(std::optional<double> strain) {
  constexpr double negligible = 0.1;
  if (!(strain.value_or(0) > negligible)) return "";
  return fmt::format(
      "a material that yields is strained by {:.0f} % in a single phase: the grid of the start, squeezed so far, bears "
      "loads that the material may not; expected a smaller load, or phases that end (phase.max_motion = 0.1)",
      100 * *strain);
}

// A note on a law of small strains in a body that turns or strains by more; empty: there is nothing to say.
std::string note_on_small_strain(const LagrangianPhase& phase, double t, ConstVec u) {
  constexpr double negligible = 0.1;
  if (!phase.info().of_small_strain || phase.info().dim == 1) return "";
  const LargestStrain most = largest_strain(phase, t, u);
  if (!(most.strain > negligible)) return "";
  return fmt::format(
      "the largest of the displacement gradients is {:.2g}: a law of small strains takes a rotation for a strain, and "
      "is off by about as much; expected a smaller motion, or law = \"hencky\" or \"neo-hookean\"",
      most.strain);
}

class SinglePhase : public Watcher {
 public:
  /// Takes an equilibrium back if the body has gone nearly as far as its own size, and doubts one that goes some way.
  void confirm(RunState& run, Verdict& verdict) override {
    const LagrangianPhase& phase = *run.model.phase;
    const auto most = strain_in_single_phase(phase, run.t, run.motion->u());
    const std::string said = most ? note_on_single_phase(most->strain) : "";
    if (said.empty()) return;
    if (most->strain <= largest_single_phase_strain) {
      verdict.reason += "; but " + said;
      return;
    }
    verdict = {RunStatus::step_limit, fmt::format("no equilibrium: {}; {} is strained most; it ended with {}", said,
                                                  to_string(phase.diagnosis().of_point(most->point)), verdict.reason)};
  }
  void fill_state(Summary& summary, RunState& run) override {
    if (const auto most = strain_in_single_phase(*run.model.phase, run.t, run.motion->u()))
      summary.single_phase_strain = most->strain;
    add_note(summary, note_on_single_phase(summary.single_phase_strain));
    add_note(summary, note_on_small_strain(*run.model.phase, run.t, run.motion->u()));
  }
};

}  // namespace

std::unique_ptr<Watcher> watch_single_phase() { return std::make_unique<SinglePhase>(); }

}  // namespace stillpoint
