// Gauss and Legendre's quadrature of an interval.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <gsl/gsl_integration.h>

namespace stillpoint {

/// Positions in [0, 1] and their weights, exact up to a degree.
struct UnitRule {
  explicit UnitRule(int degree) : at(static_cast<std::size_t>(degree / 2 + 1)), weight(at.size()) {
    const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
        gsl_integration_glfixed_table_alloc(at.size()), gsl_integration_glfixed_table_free);
    for (std::size_t k = 0; k < at.size(); ++k) gsl_integration_glfixed_point(0, 1, k, &at[k], &weight[k], table.get());
  }
  std::vector<double> at, weight;
};

}  // namespace stillpoint
