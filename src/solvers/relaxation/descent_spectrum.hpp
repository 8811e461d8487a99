// The lowest frequency among the modes that a conjugate descent has met, from its coefficients: conjugate gradients are
// Lanczos' method on M⁻¹K [Golub and Van Loan 2013, §11.3]. With the step α_j along the j-th direction and β_j at its
// end
//
//   T_jj = 1/α_j + β_{j−1}/α_{j−1},   T_{j,j+1}² = β_j/α_j²
//
// and the lowest eigenvalue of T approaches from above the ω₁² of the modes that the loads excite: once the residual is
// small the descent has met all of them, and a mode that it has not met has no part in the error either.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace stillpoint {

class DescentSpectrum {
 public:
  DescentSpectrum();

  /// Begins another descent with an empty T.
  void begin();
  /// alpha: the step along the last direction [s²]; beta: the share of it in the next direction.
  void add(double alpha, double beta);
  /// ω₁² [1/s²]; empty unless the last third of the steps has changed it by less than this share of it.
  std::optional<double> lowest(double share = 0.02) const;

  void archive(const StateArchive& state);

 private:
  static constexpr std::size_t most = 1 << 14;

  std::vector<double> diagonal_, off_diagonal_squared_;  // of T
  double carried_ = 0;                                   // β_{j−1}/α_{j−1}
};

}  // namespace stillpoint
