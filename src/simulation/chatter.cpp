#include "simulation/chatter.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace stillpoint {

std::optional<std::string> Chatter::observe(const LagrangianPhase& phase, double way, double residual, double cell) {
  constexpr double long_way = 100;  // cells: of a body that settles the points come to within that
  constexpr double nowhere = 0.01;  // of the way
  constexpr double smaller = 0.5;   // a residual that has come down
  way_ += way;
  ++phases_;
  if (!position_.empty() && way_ < long_way) return std::nullopt;
  const std::vector<double> now = phase.fields().positions();
  double furthest = 0;
  for (std::size_t i = 0; i < position_.size(); ++i) furthest = std::max(furthest, std::abs(now[i] - position_[i]));
  const bool chatters = !position_.empty() && furthest <= nowhere * way_ * cell && residual > smaller * residual_;
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

}  // namespace stillpoint
