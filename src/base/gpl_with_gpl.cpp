#include "base/gpl.hpp"

#include <cholmod.h>
#include <fmt/format.h>
#include <gsl/gsl_version.h>

namespace stillpoint {

std::vector<std::pair<std::string, std::string>> gpl_versions() {
  return {{"cholmod", fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)},
          {"gsl", gsl_version}};
}

std::string why_no_integrator(const std::string& /*name*/) { return {}; }

std::string_view why_no_petsc() {
  return "this stillpoint was built without PETSc; install libpetsc-real-dev (Debian's package) and build it again";
}

std::string_view missing_without_gpl() { return {}; }

}  // namespace stillpoint
