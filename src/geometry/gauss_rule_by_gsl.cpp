#include <memory>

#include <gsl/gsl_integration.h>

#include "geometry/gauss_rule.hpp"

namespace stillpoint {

GaussRule::GaussRule(double a, double b, std::size_t n) : at(n), weight(n) {
  const std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)> table(
      gsl_integration_glfixed_table_alloc(n), gsl_integration_glfixed_table_free);
  for (std::size_t k = 0; k < n; ++k) gsl_integration_glfixed_point(a, b, k, &at[k], &weight[k], table.get());
}

}  // namespace stillpoint
