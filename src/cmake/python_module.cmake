# The Python package stillpoint: its compiled half, _core, with the library inside, beside the files of
# src/python/stillpoint. PYTHONPATH=build/release/python finds it.
set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the module is for")
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
set(PYBIND11_FINDPYTHON ON)
find_package(pybind11 CONFIG REQUIRED)
set(package ${PROJECT_BINARY_DIR}/python/stillpoint)

file(GLOB STILLPOINT_PYTHON_SOURCES CONFIGURE_DEPENDS src/python/*.cpp)
pybind11_add_module(stillpoint_python MODULE NO_EXTRAS ${STILLPOINT_PYTHON_SOURCES})
set_target_properties(stillpoint_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package})
target_include_directories(stillpoint_python PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_compile_definitions(stillpoint_python PRIVATE STILLPOINT_VERSION="${PROJECT_VERSION}")
target_link_libraries(stillpoint_python PRIVATE stillpoint stillpoint_flags ${STILLPOINT_DEPENDENCIES})

file(GLOB files CONFIGURE_DEPENDS src/python/stillpoint/*.py src/python/stillpoint/*.pyi src/python/stillpoint/py.typed)
set(copies "")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME)
  add_custom_command(OUTPUT ${package}/${name} DEPENDS ${file} COMMENT ""
    COMMAND ${CMAKE_COMMAND} -E copy ${file} ${package}/${name})
  list(APPEND copies ${package}/${name})
endforeach()
add_custom_target(stillpoint_python_files ALL DEPENDS ${copies})
add_dependencies(stillpoint_python stillpoint_python_files)

# Where Debian's Python looks for modules of this prefix.
if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
  set(place lib/python3/dist-packages)
else()
  set(place lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/dist-packages)
endif()
set(STILLPOINT_PYTHON_DIR ${place} CACHE STRING "Where the Python package is installed, below the prefix")
install(TARGETS stillpoint_python LIBRARY DESTINATION ${STILLPOINT_PYTHON_DIR}/stillpoint COMPONENT python)
install(FILES ${files} DESTINATION ${STILLPOINT_PYTHON_DIR}/stillpoint COMPONENT python)
