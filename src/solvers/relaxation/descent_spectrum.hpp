// The lowest frequency that a conjugate descent has met, from its coefficients: conjugate gradients are Lanczos' method
// on M⁻¹K [Golub and Van Loan 2013, §11.3]. With the step α_j along the j-th direction and β_j at its end
//
//   T_jj = 1/α_j + β_{j−1}/α_{j−1},   T_{j,j+1}² = β_j/α_j²
//
// and the lowest eigenvalue of T is ω₁² from above, of the motions that the loads drive: where the residual has become
// small they are all met, and what is not met is in no error either.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace stillpoint {

class DescentSpectrum {
 public:
  DescentSpectrum();

  /// Another descent begins.
  void begin();
  /// alpha: the step along the last direction [s²]; beta: by which the next one has turned.
  void add(double alpha, double beta);
  /// ω₁² [1/s²], if the last third of the steps has changed it by less than a share.
  std::optional<double> lowest(double share = 0.02) const;

  void archive(const StateArchive& state);

 private:
  static constexpr std::size_t most = 1 << 14;

  std::vector<double> diagonal_, off_diagonal_squared_;  // of T
  double carried_ = 0;                                   // β_{j−1}/α_{j−1}
};

}  // namespace stillpoint
