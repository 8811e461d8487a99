#include "base/versions.hpp"

#include <Eigen/Core>
#include <fmt/format.h>
#include <hdf5.h>
#include <sundials/sundials_config.h>

#include "base/gpl.hpp"

namespace stillpoint {

std::vector<std::pair<std::string, std::string>> library_versions() {
  std::vector<std::pair<std::string, std::string>> versions{
      {"stillpoint", STILLPOINT_VERSION},
      {"sundials", SUNDIALS_VERSION},
      {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
  };
  for (auto& version : gpl_versions()) versions.push_back(std::move(version));
  versions.emplace_back("hdf5", fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE));
  versions.emplace_back("compiler", __VERSION__);
  return versions;
}

}  // namespace stillpoint
