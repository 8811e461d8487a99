# Debian packages, by `cpack --preset package` (scripts/package): one of each component of src/cmake/install.cmake.
#   stillpoint              command      the command, its man page, its completions, what draws, the scenes
#   libstillpoint0          library      the shared library, once for each of STILLPOINT_INSTRUCTION_SETS
#   libstillpoint-dev       development  headers, CMake package, pkg-config
#   python3-stillpoint      python       the Python module
#   stillpoint-multigrid    multigrid    what calls PETSc, which half the users never need and which brings MPI
#   stillpoint-mpi          ranks        what calls MPI, for runs of several processes
option(STILLPOINT_PACKAGES "Prepare the files that only Debian's packages have" OFF)
if(NOT STILLPOINT_PACKAGES)
  return()
endif()
if(NOT BUILD_SHARED_LIBS OR NOT STILLPOINT_PYTHON)
  message(FATAL_ERROR "STILLPOINT_PACKAGES needs BUILD_SHARED_LIBS=ON and STILLPOINT_PYTHON=ON")
endif()
# Debian's tools take the address from there as well.
set(STILLPOINT_PACKAGE_CONTACT $ENV{DEBEMAIL} CACHE STRING "Whom the packages name for questions: an address")
if(NOT STILLPOINT_PACKAGE_CONTACT)
  set(STILLPOINT_PACKAGE_CONTACT stillpoint@localhost)  # for packages that stay in one house
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stillpoint)
set(CPACK_PACKAGE_CONTACT "The Stillpoint developers <${STILLPOINT_PACKAGE_CONTACT}>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has one of its own
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL "")

# stillpoint_package(COMPONENT NAME SUMMARY DESCRIPTION [KEY VALUE]…): a package; KEY is one of CPack's CPACK_DEBIAN_…
# without the name of the component, such as PACKAGE_DEPENDS.
macro(stillpoint_package component name summary description)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}")
  set(words ${ARGN})
  while(words)
    list(POP_FRONT words key value)
    set(CPACK_DEBIAN_${upper}_${key} "${value}")
  endwhile()
  # Every package has its own folder in share/doc.
  install(FILES src/cmake/packages/copyright ${PROJECT_BINARY_DIR}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
endmacro()

configure_file(src/cmake/packages/changelog ${PROJECT_BINARY_DIR}/changelog @ONLY)
execute_process(COMMAND gzip -9nkf ${PROJECT_BINARY_DIR}/changelog COMMAND_ERROR_IS_FATAL ANY)

set(same "(= ${PROJECT_VERSION})")
set(about "Stillpoint finds quasi-static equilibrium by dynamic relaxation in the
material point method: large deformation, plastic flow and contact of solids
and soils. Every run reports its speed beside its error.\n.\n")
set(python "${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}")
math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
set(next_python "${Python_VERSION_MAJOR}.${next_minor}")

# Which package a program needs that links the library; and that the loader's cache is out of date.
file(WRITE ${PROJECT_BINARY_DIR}/shlibs "libstillpoint 0 libstillpoint0 ${same}\n")
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/shlibs ${PROJECT_BINARY_DIR}/triggers)
set(scripts ${PROJECT_SOURCE_DIR}/src/cmake/packages/python)  # compile Python, and take that away again
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${scripts}/postinst ${scripts}/prerm)

stillpoint_package(command stillpoint "quasi-static equilibrium in the material point method"
  "${about}This package has the command and its scenes."
  PACKAGE_DEPENDS "libstillpoint0 ${same}"
  PACKAGE_RECOMMENDS "libopenblas0-openmp"
  PACKAGE_SUGGESTS "python3-matplotlib, python3-h5py, python3-stillpoint, stillpoint-multigrid, stillpoint-mpi")
stillpoint_package(library libstillpoint0 "material point method, relaxed to equilibrium - library"
  "${about}This package has the shared library, for several processors of this
architecture, of which the loader takes the widest that it can."
  PACKAGE_SECTION libs
  PACKAGE_RECOMMENDS "libopenblas0-openmp")
stillpoint_package(development libstillpoint-dev "material point method, relaxed to equilibrium - development"
  "${about}This package has the headers, the CMake package and the pkg-config file."
  PACKAGE_SECTION libdevel
  PACKAGE_SHLIBDEPS OFF
  PACKAGE_DEPENDS "libstillpoint0 ${same}, libeigen3-dev (>= 3.4)")
stillpoint_package(python python3-stillpoint "material point method, relaxed to equilibrium - Python 3"
  "${about}This package has the Python module."
  PACKAGE_SECTION python
  PACKAGE_DEPENDS "libstillpoint0 ${same}, python3 (>= ${python}~), python3 (<< ${next_python}), python3-numpy"
  PACKAGE_SUGGESTS "python3-matplotlib, python3-h5py, python3-pandas, python3-meshio, stillpoint")
if(TARGET stillpoint_multigrid)
  stillpoint_package(multigrid stillpoint-multigrid "material point method, relaxed to equilibrium - multigrid mass"
    "${about}This package has what mass.kind = \"multigrid\" needs, for large bodies
in space."
    PACKAGE_DEPENDS "libstillpoint0 ${same}")
endif()
if(TARGET stillpoint_ranks)
  stillpoint_package(ranks stillpoint-mpi "material point method, relaxed to equilibrium - several processes"
    "${about}This package has what a run needs that mpirun starts as several
processes, on one machine or on several."
    PACKAGE_DEPENDS "libstillpoint0 ${same}, openmpi-bin")
endif()
include(CPack)
