// A build without GSL has none of GSL's steppers.
#include <stdexcept>

#include "solvers/integrators/integrator_families.hpp"

namespace stillpoint {

std::vector<Method> gsl_methods() { return {}; }

std::unique_ptr<Stepper> make_gsl(const IntegratorOptions& options, RelaxationSystem& /*system*/) {
  throw std::logic_error("there is no method '" + options.method + "'");
}

}  // namespace stillpoint
