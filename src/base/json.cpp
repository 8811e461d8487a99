#include "base/json.hpp"

#include <Eigen/Core>
#include <fmt/format.h>
#include <hdf5.h>
#include <sundials/sundials_config.h>

#include "base/gpl.hpp"

namespace stillpoint {

Json versions_of_libraries() {
  Json versions = {{"stillpoint", STILLPOINT_VERSION},
                   {"sundials", SUNDIALS_VERSION},
                   {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
  for (const auto& [name, version] : gpl_versions()) versions[name] = version;
  versions["hdf5"] = fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE);
  versions["compiler"] = __VERSION__;
  return versions;
}

}  // namespace stillpoint
