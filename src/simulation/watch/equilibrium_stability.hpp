// The stability of an equilibrium: a column in line with a load beyond Euler's is in balance, and falls at the least
// disturbance.
//
//   K(u) x = ω² M x,   K = ∂R/∂u − ∂F/∂u:   stable if every ω² > 0, neutral if the lowest is 0, unstable if it is less.
#pragma once

#include <string>
#include <vector>

#include "simulation/watcher.hpp"

namespace stillpoint {

struct EquilibriumStability {
  enum class Kind { not_tested, stable, neutral, unstable };
  Kind kind = Kind::not_tested;
  // The lowest mode, if it is neutral or unstable:
  double omega_squared = 0;     // ω² [1/s²]
  std::vector<double> mode;     // x at the points, the longest of length 1, (P × dim)
  std::vector<double> largest;  // the position at which x is longest [m]
};

/// The stability of the equilibrium (t, u). It is tested if a factor fits into memory and K(u) can have changed its
/// sign: in bodies that are nonlinear, without history, without walls and where no friction slips. residual: how far
/// from balance u is.
EquilibriumStability stability_of(const LagrangianPhase& phase, double t, ConstVec u, double residual);

/// A sentence that says what a neutral or an unstable equilibrium means.
std::string description(const EquilibriumStability& stability);

class StabilityTest : public Watcher {
 public:
  /// Takes an equilibrium back if it is unstable, and leaves its mode in unstable_mode.csv; or if the body strays along
  /// motions that strain no point. Throws std::filesystem::filesystem_error.
  void confirm(RunState& run, Verdict& verdict) override;
  void fill_state(Summary& summary, RunState& run) override;

 private:
  EquilibriumStability stability_;
};

}  // namespace stillpoint
