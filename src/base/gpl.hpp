// What a build is with the libraries under the GPL (GSL, UMFPACK, CHOLMOD, and PETSc as Debian builds it), and what
// one without them (STILLPOINT_GPL=OFF) says of what is missing.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stillpoint {

/// Of those that this build is linked with.
std::vector<std::pair<std::string, std::string>> gpl_versions();

/// Why there is no integrator of this name; empty: for no reason that lies in the build.
std::string why_no_integrator(const std::string& name);

/// Why a build has no module that calls PETSc, and what to do about it.
std::string_view why_no_petsc();

/// A line of its own for the version of the program; empty: nothing is missing.
std::string_view missing_without_gpl();

}  // namespace stillpoint
