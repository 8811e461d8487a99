# Everything that the library links, from Debian's packages (scripts/packages lists them).
# This file is used twice: by the build, and, installed, by find_package(stillpoint). STILLPOINT_GPL: with the libraries
# under the GPL.
if(NOT CMAKE_FIND_PACKAGE_NAME)  # the build: nobody called find_package, and what is missing is an error at once
  set(CMAKE_FIND_PACKAGE_NAME stillpoint)
  set(stillpoint_FIND_REQUIRED TRUE)
endif()

include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 CONFIG)
if(STILLPOINT_INSTALLED_AS STREQUAL SHARED)  # with all that it needs inside or linked
  return()
endif()
find_dependency(fmt CONFIG)
find_dependency(muparser CONFIG)
find_dependency(tomlplusplus CONFIG)
find_dependency(nlohmann_json CONFIG)
find_dependency(OpenMP COMPONENTS CXX)
find_dependency(ZLIB)
find_dependency(Qhull CONFIG)
find_dependency(SUNDIALS CONFIG COMPONENTS arkode nvecserial)

if(STILLPOINT_GPL)
  find_dependency(GSL)
endif()

# SuiteSparse, ARPACK and HDF5 bring no CMake package in Debian: a target for each. (CMake's own FindHDF5 compiles a C
# program, so that a project in C++ alone could not find stillpoint.)
if(STILLPOINT_GPL AND NOT TARGET stillpoint::cholmod)
  find_library(STILLPOINT_CHOLMOD cholmod REQUIRED)
  find_path(STILLPOINT_CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  add_library(stillpoint::cholmod UNKNOWN IMPORTED)
  set_target_properties(stillpoint::cholmod PROPERTIES
    IMPORTED_LOCATION ${STILLPOINT_CHOLMOD} INTERFACE_INCLUDE_DIRECTORIES ${STILLPOINT_CHOLMOD_INCLUDE})

  find_library(STILLPOINT_UMFPACK umfpack REQUIRED)
  find_path(STILLPOINT_UMFPACK_INCLUDE umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
  add_library(stillpoint::umfpack UNKNOWN IMPORTED)
  set_target_properties(stillpoint::umfpack PROPERTIES
    IMPORTED_LOCATION ${STILLPOINT_UMFPACK} INTERFACE_INCLUDE_DIRECTORIES ${STILLPOINT_UMFPACK_INCLUDE})
endif()

if(NOT TARGET stillpoint::arpack)
  find_library(STILLPOINT_ARPACK arpack REQUIRED)
  add_library(stillpoint::arpack UNKNOWN IMPORTED)
  set_target_properties(stillpoint::arpack PROPERTIES IMPORTED_LOCATION ${STILLPOINT_ARPACK})

  find_library(STILLPOINT_HDF5 NAMES hdf5_serial hdf5 REQUIRED)
  find_path(STILLPOINT_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
  add_library(stillpoint::hdf5 UNKNOWN IMPORTED)
  set_target_properties(stillpoint::hdf5 PROPERTIES
    IMPORTED_LOCATION ${STILLPOINT_HDF5} INTERFACE_INCLUDE_DIRECTORIES ${STILLPOINT_HDF5_INCLUDE})
endif()
