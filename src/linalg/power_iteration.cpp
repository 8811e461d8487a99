#include "linalg/power_iteration.hpp"

#include <stillpoint/vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/parallel_loop.hpp"
#include "base/stop_request.hpp"

namespace stillpoint {
namespace {

// Estimates the error that ρ_k still has, from its changes δ_k = ρ_k − ρ_{k−1}. The change alone would stop a slow
// iteration far from λ.
//   one mode left beside the dominant one:  λ − ρ_k = δ_k (q + q² + …) = δ_k q/(1 − q),   q = δ_k/δ_{k−1};
//   many, if the spectrum is crowded near λ, and q still grows:  λ − ρ_k ∝ 1/k, so λ − ρ_k ≈ k δ_k.
// The larger estimate has to be within the tolerance three times running. Changes of rounding size end the iteration as
// well. A B⁻¹ of condition κ adds noise of κ eps to ρ, which never falls in exact arithmetic: after many falls ρ is as
// good as it will be, whatever the tolerance is, and the estimates above mean nothing.
class MissingPart {
 public:
  explicit MissingPart(double tolerance) : tolerance_(tolerance) {}

  // Whether the iteration has converged; rho: its value after k iterations.
  bool converged(double rho, int k) {
    const double change = std::abs(rho - previous_), q = change / previous_change_;
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(rho);
    if (change <= rounding) {
      error_ = std::numeric_limits<double>::epsilon();
    } else {
      error_ =
          q < 1 ? change * std::max<double>(q / (1 - q), k) / std::abs(rho) : std::numeric_limits<double>::infinity();
    }
    held_ = error_ <= std::max(tolerance_, std::numeric_limits<double>::epsilon()) ? held_ + 1 : 0;
    constexpr double noticeable = 1e-6;  // a larger fall comes from an indefinite A
    if (rho < previous_ && change > rounding && change < noticeable * std::abs(rho)) {
      ++falls_;
      noise_ = std::max(noise_, change / std::abs(rho));
    }
    previous_ = rho;
    previous_change_ = change;
    return held_ >= 3;
  }
  bool stalled() const { return falls_ >= most_falls; }
  double error() const { return stalled() ? noise_ : error_; }

 private:
  static constexpr int most_falls = 16;

  double tolerance_;
  double previous_ = std::numeric_limits<double>::quiet_NaN(), previous_change_ = previous_;  // no value so far
  double error_ = std::numeric_limits<double>::infinity();
  int held_ = 0;
  int falls_ = 0;
  double noise_ = 0;  // the largest fall of ρ, relative to it
};

}  // namespace

PowerIterationResult power_iteration(std::size_t n, const LinearMap& apply_A, const LinearMap& solve_B,
                                     double tolerance, int max_iterations) {
  PowerIterationResult result;
  MissingPart missing(tolerance);
  const VectorSpace vectors;
  Vector x = vectors.make(n), Ax = vectors.make(n), Bx = vectors.make(n);  // B x needs no product: B (B⁻¹A x) = A x
  std::ranges::copy(start_vector(n), Bx.span().begin());
  solve_B(Bx.span(), x.span());
  while (result.iterations < max_iterations) {
    heed_stop_request();
    const double norm = std::sqrt(dot(x, Bx));  // ‖x‖_B
    if (norm == 0) {                            // A x = 0 for a random x: A = 0
      result = {0, 0, result.iterations, true};
      break;
    }
    for_each_index(n, [x = x.span().data(), norm](std::size_t i) { x[i] /= norm; });
    apply_A(x.span(), Ax.span());
    ++result.iterations;
    result.eigenvalue = dot(x, Ax);  // ρ = xᵀAx, xᵀBx = 1
    result.converged = missing.converged(result.eigenvalue, result.iterations);
    result.relative_error = missing.error();
    if (result.converged || missing.stalled() || !std::isfinite(result.eigenvalue)) break;
    if (result.iterations == max_iterations) break;
    solve_B(Ax.span(), x.span());
    std::swap(Ax, Bx);
  }
  result.x.assign(x.span().begin(), x.span().end());
  return result;
}

std::vector<double> start_vector(std::size_t n) {
  // splitmix64 [Steele, Lea, Flood, OOPSLA 2014], 53 bits of each number.
  std::vector<double> x(n);
  std::uint64_t state = 0;
  for (double& value : x) {
    std::uint64_t bits = (state += 0x9e3779b97f4a7c15);
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
    bits ^= bits >> 31;
    value = static_cast<double>(bits >> 11) * 0x1p-52 - 1;
  }
  return x;
}

}  // namespace stillpoint
