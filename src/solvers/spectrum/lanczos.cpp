// ω_max by a few steps of Lanczos' method on M⁻¹K (linalg/lanczos.hpp). The largest θ of T is below ω_max², and
//
//   ω_max² ≈ θ + β_m |s_m|
//
// exceeds it, or falls below it by a part of a per cent if the spectrum is crowded at its end [Zhou and Li, "Bounding
// the spectrum of large Hermitian matrices", Linear Algebra Appl. 435 (2011)]. Twelve applications of K give the
// accuracy for which power iteration needs hundreds.
#include "linalg/lanczos.hpp"

#include <stillpoint/spectrum.hpp>
#include <stillpoint/vector.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "linalg/power_iteration.hpp"

namespace stillpoint {

FrequencyEstimate omega_max_by_lanczos(const SemiDiscrete& system, double t, ConstVec u, int applications,
                                       std::optional<double> tolerance) {
  if (applications < 1) throw std::invalid_argument("Lanczos' method needs at least one application of K");
  const Stopwatch watch;
  const Mass& mass = system.mass();
  const LinearMap apply_K = [&](ConstVec x, Vec Kx) { system.tangents().apply(Tangent::stiffest, t, u, x, Kx); };
  const LinearMap solve_M = [&](ConstVec b, Vec x) { mass.solve(b, x); };
  const VectorSpace vectors;
  Vector x = vectors.make(system.size()), Mx = vectors.make(system.size());
  std::ranges::copy(start_vector(system.size()), x.span().begin());
  mass.apply(x.span(), Mx.span());
  Lanczos lanczos(apply_K, solve_M, std::move(Mx));
  // The relative error of ω² is twice that of ω.
  const auto is_found = [&](const Lanczos::Largest& largest) {
    return !tolerance || largest.missing <= 2 * *tolerance * largest.theta;
  };
  constexpr int between_looks = 8;
  for (int j = 0; j < applications && lanczos.step(); ++j) {
    if (tolerance && j % between_looks == 0 && is_found(lanczos.largest())) break;
  }
  const int m = lanczos.applications();
  if (!lanczos.finite()) return {0, m, watch.seconds(), false, "the tangent is not finite"};
  const Lanczos::Largest largest = m > 0 ? lanczos.largest() : Lanczos::Largest{};
  if (!(largest.theta > 0)) return {0, m, watch.seconds(), false, "K has no positive eigenvalue"};
  const double from_above = largest.theta + largest.missing;
  return {std::sqrt(from_above), m, watch.seconds(), is_found(largest),
          fmt::format("ω² between {:.6g} and {:.6g}, in all likelihood, by {} applications of K", largest.theta,
                      from_above, m)};
}

}  // namespace stillpoint
