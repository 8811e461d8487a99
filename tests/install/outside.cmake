# cmake -D … -P outside.cmake: installs the build in BUILD, then configures, builds and runs the project in OUTSIDE.
set(installed ${WORK}/installed)
set(built ${WORK}/outside)
file(REMOVE_RECURSE ${installed} ${built})  # no file of an earlier run may help

include(${CMAKE_CURRENT_LIST_DIR}/must.cmake)

must("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${installed})
must("configure" ${CMAKE_COMMAND} -S ${OUTSIDE} -B ${built} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${installed}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS} -D CMAKE_BUILD_TYPE=${CONFIG})
must("build" ${CMAKE_COMMAND} --build ${built})
must("run" ${built}/outside ${SCENE})
if(NOT "${output}${errors}" MATCHES "^residual [0-9.e+-]+\n$")
  message(FATAL_ERROR "expected 'residual <number>', got:\n${output}${errors}")
endif()
message(STATUS "${output}")
