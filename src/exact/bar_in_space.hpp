// What Saint-Venant's bars along x share: checks, and terms of their series.
#pragma once

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "exact/of_scene.hpp"

namespace stillpoint {

/// Whether the body is the bar that the parameters describe: boxes that reach from `from` to `from + size` along an
/// axis.
inline std::optional<SolutionFault> fault_of_extent(const Problem& problem, const char* key, std::size_t axis,
                                                    double from, double size) {
  const auto extent = extent_along(problem, axis);
  if (!extent || reaches(*extent, from, size)) return std::nullopt;
  return SolutionFault{key, fmt::format("the body reaches from {:g} to {:g} along {}, the bar from {:g} to {:g}",
                                        extent->first, extent->second, "xyz"[axis], from, from + size)};
}

/// Checks the section |y − y0| ≤ depth/2, |z − z0| ≤ width/2.
inline std::optional<SolutionFault> fault_of_section(const Problem& problem) {
  const double depth = parameter(problem, "depth"), width = parameter(problem, "width");
  if (auto fault = fault_of_extent(problem, "depth", 1, parameter(problem, "y0") - depth / 2, depth)) return fault;
  return fault_of_extent(problem, "width", 2, parameter(problem, "z0") - width / 2, width);
}

/// sinh x/cosh c and cosh x/cosh c for |x| ≤ c, also if cosh c itself overflows: terms of Fourier series across a
/// rectangle.
struct HyperbolicRatios {
  double sinh, cosh;
};

inline HyperbolicRatios over_cosh(double x, double c) {
  const double decay = std::exp(std::abs(x) - c) / (1 + std::exp(-2 * c)), other = std::exp(-2 * std::abs(x));
  return {std::copysign(decay * (1 - other), x), decay * (1 + other)};
}

}  // namespace stillpoint
