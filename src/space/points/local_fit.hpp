// A value at a place from those at the points around it: moving least squares [Lancaster and Salkauskas 1981].
#pragma once

#include <cstddef>
#include <vector>

namespace stillpoint {

/// c_p of the polynomial q that is nearest to values s_p,
///
///   min_q Σ_p w_p (q(ξ_p) − s_p)²,   q(0) = Σ_p c_p s_p,
///
/// so that Σ_p c_p q(ξ_p) = q(0) for every q of this degree: or of the next lower one where the points leave one of
/// that degree open, or nearly so (Σ |c_p|, by which errors at the points grow, would pass 10).
/// xi: positions seen from the place, (n × dim), about one in size, n > 0; weight: w_p > 0, (n).
std::vector<double> local_fit(const std::vector<double>& xi, const std::vector<double>& weight, std::size_t dim,
                              int degree);

}  // namespace stillpoint
