#include "base/versions.hpp"

#include <Eigen/Core>
#include <cholmod.h>
#include <fmt/format.h>
#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <sundials/sundials_config.h>

namespace stillpoint {

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {{"stillpoint", STILLPOINT_VERSION},
          {"sundials", SUNDIALS_VERSION},
          {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"cholmod", fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)},
          {"gsl", gsl_version},
          {"hdf5", fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
          {"compiler", __VERSION__}};
}

}  // namespace stillpoint
