# What draws, src/python/stillpoint/plots: files of Python's that `stillpoint plot` runs. They lie beside the program where that
# was built, in what becomes the Python package, and are installed with the command, since any Python can run them, and with
# that package, which draws by them as well.
file(GLOB plots CONFIGURE_DEPENDS src/python/stillpoint/plots/*.py)
set(copies "")
foreach(file IN LISTS plots)
  get_filename_component(name ${file} NAME)
  set(copy ${PROJECT_BINARY_DIR}/python/stillpoint/plots/${name})
  add_custom_command(OUTPUT ${copy} DEPENDS ${file} COMMENT "" COMMAND ${CMAKE_COMMAND} -E copy ${file} ${copy})
  list(APPEND copies ${copy})
endforeach()
add_custom_target(stillpoint_plots ALL DEPENDS ${copies})
add_dependencies(stillpoint_command stillpoint_plots)

install(FILES ${plots} DESTINATION ${CMAKE_INSTALL_DATADIR}/stillpoint/plots COMPONENT command)
set(place_of_package ${CMAKE_INSTALL_DATADIR})  # there is none
if(STILLPOINT_PYTHON)
  set(place_of_package ${STILLPOINT_PYTHON_DIR})
  add_dependencies(stillpoint_python stillpoint_plots)
  install(FILES ${plots} DESTINATION ${STILLPOINT_PYTHON_DIR}/stillpoint/plots COMPONENT python)
endif()
target_compile_definitions(stillpoint_command PRIVATE STILLPOINT_PYTHON_DIR="${place_of_package}"
  STILLPOINT_DATADIR="${CMAKE_INSTALL_DATADIR}" STILLPOINT_FULL_DATADIR="${CMAKE_INSTALL_FULL_DATADIR}")
