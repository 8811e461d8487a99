# The module that calls PETSc, loaded when a scene asks for multigrid: nobody else waits for PETSc and MPI to start.
# STILLPOINT_MULTIGRID_MODULE: its file name; empty: there is none.
set(STILLPOINT_MULTIGRID_MODULE "")
if(STILLPOINT_GPL AND STILLPOINT_PETSC)
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(PETSC QUIET IMPORTED_TARGET PETSc)
  endif()
  if(PETSC_FOUND AND STILLPOINT_MPI_INCLUDE AND STILLPOINT_MPI)
    add_library(stillpoint_multigrid MODULE src/linalg/gamg.cpp)
    set_target_properties(stillpoint_multigrid PROPERTIES
      PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
    target_include_directories(stillpoint_multigrid PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
    target_include_directories(stillpoint_multigrid SYSTEM PRIVATE ${STILLPOINT_MPI_INCLUDE})
    target_compile_definitions(stillpoint_multigrid PRIVATE EIGEN_MAX_ALIGN_BYTES=64)  # as of the library
    target_link_libraries(stillpoint_multigrid PRIVATE
      stillpoint_flags Eigen3::Eigen fmt::fmt PkgConfig::PETSC ${STILLPOINT_MPI})
    install(TARGETS stillpoint_multigrid LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/stillpoint COMPONENT multigrid)
    set(STILLPOINT_MULTIGRID_MODULE stillpoint_multigrid.so)
  else()
    message(STATUS "PETSc (libpetsc-real-dev) is not found: mass.kind = \"multigrid\" will be refused")
  endif()
endif()
