include(CMakePackageConfigHelpers)
set(STILLPOINT_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/stillpoint)

# Eigen aligns by the processor that it is compiled for. With -march=native in the library and not in a program that
# links it, one would free what the other allocated in another way: both take the widest alignment instead.
target_compile_definitions(stillpoint PUBLIC EIGEN_MAX_ALIGN_BYTES=64)

# Our own compiler flags stay here: nothing that is installed names them.
get_target_property(links stillpoint INTERFACE_LINK_LIBRARIES)
list(REMOVE_ITEM links $<LINK_ONLY:stillpoint_flags>)
set_target_properties(stillpoint PROPERTIES INTERFACE_LINK_LIBRARIES "${links}")

# With BUILD_SHARED_LIBS, the installed program finds its library beside it, wherever the two are put.
set_target_properties(stillpoint_command PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR})

install(TARGETS stillpoint EXPORT stillpointTargets)
install(TARGETS stillpoint_command RUNTIME)
install(DIRECTORY include/stillpoint DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT stillpointTargets NAMESPACE stillpoint:: DESTINATION ${STILLPOINT_CONFIG_DIR})

configure_package_config_file(src/cmake/stillpointConfig.cmake.in ${PROJECT_BINARY_DIR}/stillpointConfig.cmake
  INSTALL_DESTINATION ${STILLPOINT_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stillpointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stillpointConfig.cmake ${PROJECT_BINARY_DIR}/stillpointConfigVersion.cmake
              src/cmake/dependencies.cmake
        DESTINATION ${STILLPOINT_CONFIG_DIR})
