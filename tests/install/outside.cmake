# cmake -D … -P outside.cmake: installs the build in BUILD, then configures, builds and runs the project in OUTSIDE.
set(installed ${WORK}/installed)
set(built ${WORK}/outside)
file(REMOVE_RECURSE ${installed} ${built})  # no file of an earlier run may help

# must(WHAT COMMAND…): runs a command; where it fails, its output and what it was for end the test.
function(must what)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE status)
  if(NOT status STREQUAL "0")
    message(FATAL_ERROR "${what} failed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

must("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${installed})
must("configure" ${CMAKE_COMMAND} -S ${OUTSIDE} -B ${built} -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${installed}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS} -D CMAKE_BUILD_TYPE=${CONFIG})
must("build" ${CMAKE_COMMAND} --build ${built})
must("run" ${built}/outside ${SCENE})
if(NOT output MATCHES "^residual [0-9.e+-]+\n$")
  message(FATAL_ERROR "expected 'residual <number>', got:\n${output}")
endif()
message(STATUS "${output}")
