# What is installed, by components: command, library, development, python, multigrid, ranks (src/cmake/packages.cmake
# makes a Debian package of each).
include(CMakePackageConfigHelpers)
set(STILLPOINT_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/stillpoint)

# Our own compiler flags stay here: nothing that is installed names them.
get_target_property(links stillpoint INTERFACE_LINK_LIBRARIES)
list(REMOVE_ITEM links $<LINK_ONLY:stillpoint_flags>)
set_target_properties(stillpoint PROPERTIES INTERFACE_LINK_LIBRARIES "${links}")

# With BUILD_SHARED_LIBS, what is installed finds its library beside it, wherever the two are put.
set_target_properties(stillpoint_command PROPERTIES INSTALL_RPATH $ORIGIN/../${CMAKE_INSTALL_LIBDIR})

install(TARGETS stillpoint EXPORT stillpointTargets
  ARCHIVE COMPONENT development
  LIBRARY COMPONENT library NAMELINK_COMPONENT development)
install(DIRECTORY include/stillpoint DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT stillpointTargets NAMESPACE stillpoint:: DESTINATION ${STILLPOINT_CONFIG_DIR} COMPONENT development)

set(STILLPOINT_INSTALLED_AS STATIC)
if(BUILD_SHARED_LIBS)
  set(STILLPOINT_INSTALLED_AS SHARED)
endif()
configure_package_config_file(src/cmake/stillpointConfig.cmake.in ${PROJECT_BINARY_DIR}/stillpointConfig.cmake
  INSTALL_DESTINATION ${STILLPOINT_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stillpointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stillpointConfig.cmake ${PROJECT_BINARY_DIR}/stillpointConfigVersion.cmake
              src/cmake/dependencies.cmake
        DESTINATION ${STILLPOINT_CONFIG_DIR} COMPONENT development)
include(src/cmake/pkg_config.cmake)

# --- the command, with what helps to use it --------------------------------------------------------
install(TARGETS stillpoint_command RUNTIME COMPONENT command)
configure_file(src/command/stillpoint.1.in ${PROJECT_BINARY_DIR}/stillpoint.1 @ONLY)
execute_process(COMMAND gzip -9nkf ${PROJECT_BINARY_DIR}/stillpoint.1 COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${PROJECT_BINARY_DIR}/stillpoint.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES src/command/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME stillpoint COMPONENT command)
set(place site-functions)
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
  set(place vendor-completions)  # where Debian's zsh looks there
endif()
install(FILES src/command/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${place}
  RENAME _stillpoint COMPONENT command)
install(FILES src/command/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  RENAME stillpoint.fish COMPONENT command)
install(DIRECTORY problems DESTINATION ${CMAKE_INSTALL_DATADIR}/stillpoint COMPONENT command
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN "*.stl" PATTERN "*.msh" PATTERN "*.geo" PATTERN "*.json" PATTERN "*.md" PATTERN "*.py" PATTERN "*.png" PATTERN "*.ipynb")
