#include "simulation/setup/set_up_store.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stillpoint {

std::string to_string(const MassSpec& mass) {
  return fmt::format("mass {} {} {:.17g}", static_cast<int>(mass.kind.value()), static_cast<int>(mass.scaling.value()),
                     mass.factor);
}

SetUpStore::MadePhase SetUpStore::make(const Problem& problem, const PhaseBegin& begin) {
  const Stopwatch watch;
  MadePhase made{make_phase(problem, begin)};
  made.seconds = watch.seconds();
  return made;
}

SetUpStore::MadePhase SetUpStore::phase(const Problem& problem) {
  const std::string mass = to_string(problem.mass);
  {
    const std::scoped_lock lock(keeping_);
    Phases& phases = phases_[mass];
    if (!phases.idle.empty()) {
      MadePhase kept{std::move(phases.idle.back()), phases.seconds, false};
      phases.idle.pop_back();
      return kept;
    }
  }
  MadePhase made = make(problem);
  const std::scoped_lock lock(keeping_);
  phases_[mass].seconds = made.seconds;
  return made;
}

void SetUpStore::give_back(const MassSpec& mass, std::unique_ptr<LagrangianPhase> phase) {
  if (!phase || phase->history_dependent() || phase->contact() || phase->info().updated_lagrangian) return;
  const std::scoped_lock lock(keeping_);
  phases_[to_string(mass)].idle.push_back(std::move(phase));
}

std::unique_ptr<LagrangianPhase> SetUp::phase(const Problem& problem, const PhaseBegin& begin) {
  SetUpStore::MadePhase made = store_ ? store_->phase(problem) : SetUpStore::make(problem, begin);
  add("phase", made.seconds, made.made_now);
  return std::move(made.phase);
}

// A part that is made more than once, as a phase for each of two masses, counts as one.
void SetUp::add(const std::string& part, double seconds, bool made_now) {
  if (!made_now) spared_s_ += seconds;
  const auto found = std::ranges::find(parts_, part, &SetUpPart::name);
  if (found != parts_.end()) {
    found->seconds += seconds;
  } else {
    parts_.push_back({part, seconds});
  }
}

}  // namespace stillpoint
