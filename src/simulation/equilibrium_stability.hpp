// Whether an equilibrium is one that the least disturbance ends: a column in line with a load beyond Euler's is in
// balance, and falls.
//
//   K(u) x = ω² M x,   K = ∂R/∂u − ∂F/∂u:   stable if every ω² > 0, neutral if the lowest is 0, unstable if it is less.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

struct EquilibriumStability {
  enum class Kind { not_tested, stable, neutral, unstable };
  Kind kind = Kind::not_tested;
  // If neutral or unstable:
  double omega_squared = 0;     // the lowest [1/s²]
  std::vector<double> mode;     // x at the points, the longest of length 1, (P × dim)
  std::vector<double> largest;  // where it is that long [m]
};

/// Of the equilibrium (t, u). Tested where a factor fits and K(u) can have changed its sign: in bodies that are
/// nonlinear, without history and without contact. residual: how far from balance u is.
EquilibriumStability stability_of(const LagrangianPhase& phase, double t, ConstVec u, double residual);

/// "", "stable", "neutral", "unstable"
std::string to_string(EquilibriumStability::Kind kind);
/// What a neutral or unstable one means, in a sentence.
std::string description(const EquilibriumStability& stability);

/// unstable_mode.csv: position and mode of each point. Throws std::filesystem::filesystem_error.
void write_mode(const EquilibriumStability& stability, const LagrangianPhase& phase, double t, ConstVec u,
                const std::filesystem::path& folder);
/// That of an earlier run.
void remove_mode(const std::filesystem::path& folder);

}  // namespace stillpoint
