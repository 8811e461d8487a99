// The exact solution of a scene: formulas of its own, or one that the program knows (`stillpoint list solutions`).
#pragma once

#include <stillpoint/problem.hpp>

#include <memory>
#include <span>

namespace stillpoint {

/// Values at the material that was at X before the motion, at t [s]. X: (dim) [m].
class ExactSolution {
 public:
  virtual ~ExactSolution() = default;

  /// u: (dim) [m].
  virtual void displacement(std::span<const double> X, double t, std::span<double> u) const = 0;
  virtual bool has_stress() const = 0;
  /// Cauchy's; sigma: xx in one dimension, or xx, yy, zz, xy, axisymmetric rr, zz, θθ, rz [Pa]. Only if has_stress().
  virtual void stress(std::span<const double> X, double t, std::span<double> sigma) const = 0;
};

/// Of a scene that was read; null if it has none. The problem outlives it. Evaluating is not for several threads at
/// once. Throws std::domain_error if the parameters of a solution have none.
std::unique_ptr<ExactSolution> exact_solution(const Problem& problem);

}  // namespace stillpoint
