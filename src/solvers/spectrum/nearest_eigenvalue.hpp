// ARPACK's shift-invert method with a factor that the caller supplies.
#pragma once

#include <stillpoint/mass.hpp>
#include <stillpoint/spectrum.hpp>

#include <string>
#include <vector>

#include "linalg/linear_map.hpp"

namespace stillpoint {

struct NearestEigenvalue {
  double lambda = 0;
  int applications = 0;  // of (K − σM)⁻¹ M
  bool converged = false;
  std::string status;
  std::vector<double> mode;  // xᵀMx = 1, (n)
};

/// The λ of K x = λ M x nearest to σ, with its x; solve: x = (K − σM)⁻¹ b. Throws std::invalid_argument for bad
/// options.
NearestEigenvalue nearest_eigenvalue(const LinearMap& solve, const Mass& mass, double sigma,
                                     const SpectrumOptions& = {});

}  // namespace stillpoint
