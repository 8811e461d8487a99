# cmake -D … -P by_pkg_config.cmake: installs the build in BUILD, then builds OUTSIDE/main.cpp with what pkg-config says of it,
# and nothing else, and runs that. STATIC: how pkg-config is asked of a static library.
set(installed ${WORK}/installed_for_pkg_config)
file(REMOVE_RECURSE ${installed})  # no file of an earlier run may help

include(${CMAKE_CURRENT_LIST_DIR}/must.cmake)

must("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${installed})
file(GLOB_RECURSE file ${installed}/*/stillpoint.pc)
file(READ ${file} text)  # where the build would be installed, not where it was
string(REGEX REPLACE "prefix=[^\n]*" "prefix=${installed}" text "${text}")
file(WRITE ${file} "${text}")

get_filename_component(folder ${file} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${folder})
must("pkg-config" pkg-config --cflags --libs ${STATIC} stillpoint)
separate_arguments(words UNIX_COMMAND "${FLAGS} ${output}")
get_filename_component(libraries ${folder} DIRECTORY)
must("build" ${COMPILER} -std=c++20 ${OUTSIDE}/main.cpp ${words} -Wl,-rpath,${libraries} -o ${WORK}/by_pkg_config)
must("run" ${WORK}/by_pkg_config ${SCENE})
if(NOT output MATCHES "^residual [0-9.e+-]+\n$")
  message(FATAL_ERROR "expected 'residual <number>', got:\n${output}")
endif()
