#include <stillpoint/static_solution.hpp>

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "linalg/krylov.hpp"
#include "solvers/statics/subtract_product.hpp"
#include "system/largest_at.hpp"
#include "system/static_balance.hpp"

namespace stillpoint {

std::string ConjugateGradientOptions::validate() const {
  if (!(tolerance > 0)) return fmt::format("tolerance = {}, expected > 0", tolerance);
  if (max_iterations < 0) return fmt::format("max_iterations = {}, expected ≥ 0", max_iterations);
  return "";
}

StaticReport conjugate_gradients(const SemiDiscrete& system, double t, Vec u, const ConjugateGradientOptions& options) {
  if (const std::string wrong = options.validate(); !wrong.empty()) throw std::invalid_argument(wrong);
  const Stopwatch watch;
  StaticBalance balance(system, t, VectorSpace());
  StaticReport report;
  report.load_steps.emplace_back();
  std::vector<double>& residuals = report.load_steps.front().residuals;
  const std::size_t n = system.size();
  const int most = options.max_iterations > 0 ? options.max_iterations : 10 * static_cast<int>(n);
  constexpr int passes = 4;  // rounding makes the recurrence's residual too small: the true one is tested after each
  std::vector<double> du(n);
  const auto end = [&](bool converged, const std::string& reason) {
    report.converged = report.load_steps.front().converged = converged;
    report.reason = reason;
    report.load_factor = converged ? 1 : 0;
    report.force_evaluations = balance.evaluations;
    report.tangent_products = report.iterations;
    report.wall_s = watch.seconds();
    return report;
  };
  for (int pass = 0;; ++pass) {
    if (!balance.evaluate(1, u)) return end(false, "the answer of K is inadmissible: the system is not linear");
    report.residual = balance.residual();
    residuals.push_back(report.residual);
    if (report.residual <= options.tolerance)
      return end(true, fmt::format("residual {:.3g} <= tolerance {:.3g}", report.residual, options.tolerance));
    if (pass == passes || report.iterations >= most)
      return end(false, fmt::format("residual {:.3g} > tolerance {:.3g} after {} iterations, largest at {}",
                                    report.residual, options.tolerance, report.iterations,
                                    largest_at(system, std::as_const(balance.Q).span())));
    const SparseMatrix of_loads = system.tangents().of_loads(t, u);
    const LinearMap K = [&](ConstVec x, Vec Kx) {
      system.tangents().apply(Tangent::consistent, t, u, x, Kx);
      subtract_product(1, of_loads, x, Kx);
    };
    const double first = report.residual / norm(balance.Q);
    const auto result = conjugate_gradients(K, division_by(system.mass().diagonal()), balance.Q.span(), du,
                                            0.5 * options.tolerance / report.residual, most - report.iterations,
                                            [&](double r) { residuals.push_back(first * r); });
    report.iterations += result.iterations;
    if (result.indefinite) return end(false, "K is not positive definite along a direction of conjugate gradients");
    for (std::size_t i = 0; i < n; ++i) u[i] += du[i];
  }
}

}  // namespace stillpoint
