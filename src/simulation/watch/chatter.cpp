#include "simulation/watch/chatter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "scene/grid_lines.hpp"

namespace stillpoint {
namespace {

bool can_chatter(const RunState& run) {
  return run.options.stops && run.scene.stop.wants_equilibrium() && run.scene.phase.ends_by_motion() &&
         run.loads_settled();
}

}  // namespace

void Chatter::observe(RunState& run) {
  residual_at_end_.reset();
  if (run.progress >= 1) residual_at_end_ = can_chatter(run) ? run.motion->residual(run.t) : 0;
}

// A phase that has ended early, at a step that was given up, does not count.
Verdict Chatter::begin_phase(RunState& run) {
  const std::optional<double> residual = std::exchange(residual_at_end_, std::nullopt);
  if (!residual || !can_chatter(run)) return {};
  const double way = run.progress * run.scene.phase.max_motion;
  auto said = take(*run.model.phase, way, *residual, longest_of_smallest_sides(run.scene.grid));
  return said ? Verdict{RunStatus::step_limit, std::move(*said)} : Verdict{};
}

std::optional<std::string> Chatter::take(const LagrangianPhase& phase, double way, double residual, double cell) {
  constexpr double long_way = 100;            // [cells]: the points of a body that settles come to rest within it
  constexpr double negligible_share = 0.01;   // a point that goes no further than this share of the way goes nowhere
  constexpr double residual_reduction = 0.5;  // a residual that has fallen by this factor has come down
  way_ += way;
  ++phases_;
  if (!position_.empty() && way_ < long_way) return std::nullopt;
  const std::vector<double> now = phase.fields().positions();
  double furthest = 0;
  for (std::size_t i = 0; i < position_.size(); ++i) furthest = std::max(furthest, std::abs(now[i] - position_[i]));
  const bool chatters =
      !position_.empty() && furthest <= negligible_share * way_ * cell && residual > residual_reduction * residual_;
  const std::string said = fmt::format(
      "in {} phases nodes have moved by {:.0f} cells back and forth and no point by more than {:.2g}, the "
      "residual {:.2g} after {:.2g}: points that cross cells shake the body; expected a larger "
      "phase.max_motion, a smoother basis, more points per cell or a larger stop.residual",
      phases_, way_, furthest / cell, residual, residual_);
  way_ = 0;
  phases_ = 0;
  residual_ = residual;
  position_ = now;
  return chatters ? std::optional(said) : std::nullopt;
}

void Chatter::archive(const StateArchive& state, RunState& run) {
  const LagrangianPhase& phase = *run.model.phase;
  state("way", way_, "residual", residual_);
  state.none_or(phase.points() * static_cast<std::size_t>(phase.dim()), "position", position_);
  state("phases", phases_);
}

}  // namespace stillpoint
