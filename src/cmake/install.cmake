include(CMakePackageConfigHelpers)
set(STILLPOINT_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/stillpoint)

install(TARGETS stillpoint EXPORT stillpointTargets)
install(TARGETS stillpoint_flags EXPORT stillpointTargets)
install(TARGETS stillpoint_command RUNTIME)
install(DIRECTORY include/stillpoint DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT stillpointTargets NAMESPACE stillpoint:: DESTINATION ${STILLPOINT_CONFIG_DIR})

configure_package_config_file(src/cmake/stillpointConfig.cmake.in ${PROJECT_BINARY_DIR}/stillpointConfig.cmake
  INSTALL_DESTINATION ${STILLPOINT_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stillpointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stillpointConfig.cmake ${PROJECT_BINARY_DIR}/stillpointConfigVersion.cmake
              src/cmake/dependencies.cmake
        DESTINATION ${STILLPOINT_CONFIG_DIR})
