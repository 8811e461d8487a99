# Everything that the library links, from Debian's packages (scripts/packages lists them).
# This file is used twice: by the build, and, installed, by find_package(stillpoint).
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 CONFIG)
find_dependency(fmt CONFIG)
find_dependency(muparser CONFIG)
find_dependency(tomlplusplus CONFIG)
find_dependency(nlohmann_json CONFIG)
find_dependency(OpenMP COMPONENTS CXX)
find_dependency(GSL)
find_dependency(SUNDIALS CONFIG COMPONENTS arkode nvecserial)
find_library(STILLPOINT_CHOLMOD cholmod REQUIRED)
find_library(STILLPOINT_ARPACK arpack REQUIRED)
