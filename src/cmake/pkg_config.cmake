# stillpoint.pc, by which pkg-config tells what a program has to link. A shared library brings what it needs itself; what a
# static one needs stands in the private lines, which `pkg-config --static` adds.
set(STILLPOINT_PC_PRIVATE "")
if(NOT BUILD_SHARED_LIBS)
  set(libraries ${STILLPOINT_ARPACK} ${STILLPOINT_HDF5})  # of which CMake knows the files
  set(modules "fmt, muparser, tomlplusplus, zlib, qhull_r")
  if(STILLPOINT_GPL)
    list(APPEND libraries ${STILLPOINT_CHOLMOD} ${STILLPOINT_UMFPACK})
    string(APPEND modules ", gsl")
  endif()
  list(TRANSFORM libraries REPLACE "^(.*)/lib([^/]+)[.](so|a)$" "-L\\1 -l\\2")
  get_filename_component(folder ${SUNDIALS_DIR}/../.. ABSOLUTE)  # of its CMake package, lib/cmake/sundials
  list(APPEND libraries -L${folder} -lsundials_arkode -lsundials_nvecserial)
  if(TARGET SUNDIALS::core)  # from release 7 on
    list(APPEND libraries -lsundials_core)
  endif()
  list(APPEND libraries ${OpenMP_CXX_FLAGS} -ldl)
  get_target_property(options stillpoint INTERFACE_LINK_OPTIONS)
  list(TRANSFORM options REPLACE "^LINKER:" "-Wl,")
  list(APPEND libraries ${options})
  list(JOIN libraries " " libraries)
  set(STILLPOINT_PC_PRIVATE "Requires.private: ${modules}\nLibs.private: ${libraries}\n")
endif()
configure_file(src/cmake/stillpoint.pc.in ${PROJECT_BINARY_DIR}/stillpoint.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/stillpoint.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
