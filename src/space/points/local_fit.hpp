// Interpolation of a value at a place from those at the points around it: moving least squares [Lancaster and
// Salkauskas 1981].
#pragma once

#include <cstddef>
#include <vector>

namespace stillpoint {

/// The coefficients c_p of the polynomial q that is nearest to values s_p,
///
///   min_q Σ_p w_p (q(ξ_p) − s_p)²,   q(0) = Σ_p c_p s_p,
///
/// so that Σ_p c_p q(ξ_p) = q(0) for every q of this degree, or of a lower one if the points do not determine the
/// polynomials of this degree, or hardly do (Σ |c_p|, by which errors at the points grow, would exceed 10). xi:
/// positions relative to the place, (n × dim), about one in size, n > 0; weight: w_p > 0, (n).
std::vector<double> local_fit(const std::vector<double>& xi, const std::vector<double>& weight, std::size_t dim,
                              int degree);

}  // namespace stillpoint
