// ω_max by a few steps of Lanczos' method on M⁻¹K, symmetric in xᵀMy [Parlett, The Symmetric Eigenvalue Problem, 1980,
// ch. 13]:
//
//   β_j q_{j+1} = M⁻¹K q_j − α_j q_j − β_{j−1} q_{j−1},   α_j = q_jᵀK q_j,   qᵀMq = 1
//
// The largest eigenvalue θ of the tridiagonal matrix T of the α and β is below ω_max²; some eigenvalue lies within
// β_m |s_m| of it, s_m the last entry of its eigenvector of T, and
//
//   ω_max² ≈ θ + β_m |s_m|
//
// is above it, or below by a part of a per cent if the spectrum is crowded at its end [Zhou and Li, "Bounding the
// spectrum of large Hermitian matrices", Linear Algebra Appl. 435 (2011)]. Twelve applications of K do what power
// iteration needs hundreds for, as they keep the polynomial that it throws away.
#include <stillpoint/spectrum.hpp>
#include <stillpoint/vector.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"
#include "linalg/power_iteration.hpp"

namespace stillpoint {
namespace {

struct LargestEigenvalue {
  double theta;    // of T
  double missing;  // β_m |s_m|
};

LargestEigenvalue largest_eigenvalue(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const auto m = static_cast<Eigen::Index>(alpha.size());
  const Eigen::Map<const Eigen::VectorXd> diagonal(alpha.data(), m), off_diagonal(beta.data(), m - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> T;
  T.computeFromTridiagonal(diagonal, off_diagonal);
  return {T.eigenvalues()(m - 1), beta.back() * std::abs(T.eigenvectors()(m - 1, m - 1))};
}

// Of ω² twice the share of ω.
bool is_found(const LargestEigenvalue& largest, double tolerance) {
  return largest.missing <= 2 * tolerance * largest.theta;
}

}  // namespace

FrequencyEstimate omega_max_by_lanczos(const SemiDiscrete& system, double t, ConstVec u, int applications,
                                       std::optional<double> tolerance) {
  if (applications < 1) throw std::invalid_argument("Lanczos' method needs at least one application of K");
  const Stopwatch watch;
  const Mass& mass = system.mass();
  const std::size_t n = system.size();
  std::vector<double> alpha, beta;
  const VectorSpace vectors;
  Vector q = vectors.make(n), last_q = vectors.make(n), Kq = vectors.make(n), z = vectors.make(n), Mz = vectors.make(n);
  std::ranges::copy(start_vector(n), q.span().begin());
  mass.apply(q.span(), Mz.span());
  double norm = std::sqrt(dot(q, Mz));
  for_each_index(n, [q = q.span().data(), norm](std::size_t i) { q[i] /= norm; });
  double last_beta = 0, bound = 0;
  constexpr double rounding = 1e-12;
  for (int j = 0; j < applications; ++j) {
    heed_stop_request();
    system.tangents().apply(Tangent::elastic, t, u, q.span(), Kq.span());
    alpha.push_back(dot(q, Kq));
    mass.solve(Kq.span(), z.span());
    for_each_index(n, [=, z = z.span().data(), q = q.span().data(), last_q = last_q.span().data(),
                       a = alpha.back()](std::size_t i) { z[i] -= a * q[i] + last_beta * last_q[i]; });
    mass.apply(z.span(), Mz.span());
    norm = std::sqrt(std::max(0.0, dot(z, Mz)));
    beta.push_back(norm);
    if (!std::isfinite(alpha.back()) || !std::isfinite(norm)) {
      return {0, j + 1, watch.seconds(), false, "the tangent is not finite"};
    }
    bound = std::max(bound, std::abs(alpha.back()) + last_beta + norm);
    if (norm <= rounding * bound) break;  // the start lies in what has been seen
    constexpr int between_looks = 8;
    if (tolerance && j % between_looks == 0 && is_found(largest_eigenvalue(alpha, beta), *tolerance)) break;
    last_beta = norm;
    std::swap(last_q, q);
    for_each_index(n, [q = q.span().data(), z = z.span().data(), norm](std::size_t i) { q[i] = z[i] / norm; });
  }

  const LargestEigenvalue largest = largest_eigenvalue(alpha, beta);
  const auto m = static_cast<int>(alpha.size());
  if (!(largest.theta > 0)) return {0, m, watch.seconds(), false, "K has no positive eigenvalue"};
  const double from_above = largest.theta + largest.missing;
  return {std::sqrt(from_above), m, watch.seconds(), !tolerance || is_found(largest, *tolerance),
          fmt::format("ω² between {:.6g} and {:.6g}, in all likelihood, by {} applications of K", largest.theta,
                      from_above, m)};
}

}  // namespace stillpoint
