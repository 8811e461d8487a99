// The exact solution of a scene: the scene's own formulas, or a built-in solution (`stillpoint list solutions`).
#pragma once

#include <stillpoint/problem.hpp>

#include <memory>
#include <span>

namespace stillpoint {

/// Values at the material point whose undeformed position is X, at t [s]. X: (dim) [m].
class ExactSolution {
 public:
  virtual ~ExactSolution() = default;

  /// u: (dim) [m].
  virtual void displacement(std::span<const double> X, double t, std::span<double> u) const = 0;
  virtual bool has_stress() const = 0;
  /// The Cauchy stress; sigma: xx in one dimension, or xx, yy, zz, xy, axisymmetric rr, zz, θθ, rz [Pa]. Only if
  /// has_stress().
  virtual void stress(std::span<const double> X, double t, std::span<double> sigma) const = 0;
};

/// Makes the exact solution of a scene; null if it has none. The problem must outlive it. One object must not be
/// evaluated by several threads at once. Throws std::domain_error if there is no solution for the given parameters.
std::unique_ptr<ExactSolution> exact_solution(const Problem& problem);

}  // namespace stillpoint
