// The share of libraries under the GPL (GSL, UMFPACK, CHOLMOD, and PETSc as Debian builds it) in a build, and the
// messages of a build without them (STILLPOINT_GPL=OFF) about what is missing.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stillpoint {

/// Names and versions of those libraries that this build is linked with.
std::vector<std::pair<std::string, std::string>> gpl_versions();

/// Why this build has no integrator of this name; empty if the build is not the reason.
std::string why_no_integrator(const std::string& name);

/// Why this build has no module that calls PETSc, and what to do about it.
std::string_view why_no_petsc();

/// A line of its own for the output of the program's version; empty if nothing is missing.
std::string_view missing_without_gpl();

}  // namespace stillpoint
