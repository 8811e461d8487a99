#include "base/gpl.hpp"

#include <fmt/format.h>

namespace stillpoint {

std::vector<std::pair<std::string, std::string>> gpl_versions() { return {}; }

std::string why_no_integrator(const std::string& name) {
  if (!name.starts_with("gsl:")) return {};
  return fmt::format(
      "'{}' is GSL's, and this stillpoint was built without the libraries under the GPL; expected leapfrog, "
      "symplectic-euler or erk:<table>, or a build with STILLPOINT_GPL=ON",
      name);
}

std::string_view why_no_petsc() {
  return "this stillpoint was built without the libraries under the GPL, which Debian's PETSc is linked with; install "
         "libpetsc-real-dev and build it again with STILLPOINT_GPL=ON";
}

std::string_view missing_without_gpl() {
  return "\nbuilt without the libraries under the GPL: no gsl:<stepper> integrators, no mass.kind = \"multigrid\"";
}

}  // namespace stillpoint
