# What a build has with the libraries under the GPL, or without them (STILLPOINT_GPL=OFF). What one of them does and
# something else can do too stands in two files, of which one is compiled: NAME_by_LIBRARY.cpp or NAME_with_gpl.cpp, and
# NAME_without_gpl.cpp, by Eigen and Boost.
set(STILLPOINT_OF_GPL "(_by_gsl|_by_cholmod|_by_umfpack|_with_gpl|/quiet_gsl)(_test)?[.]cpp$")
set(STILLPOINT_WITHOUT_GPL "_without_gpl(_test)?[.]cpp$")

# leave_out_by_gpl(LIST): takes the sources of the other kind of build out of a list.
function(leave_out_by_gpl list_name)
  if(STILLPOINT_GPL)
    list(FILTER ${list_name} EXCLUDE REGEX ${STILLPOINT_WITHOUT_GPL})
  else()
    list(FILTER ${list_name} EXCLUDE REGEX ${STILLPOINT_OF_GPL})
  endif()
  set(${list_name} "${${list_name}}" PARENT_SCOPE)
endfunction()

# Those of the second kind with what they need of the rest, for a program that tests them beside the first.
set(STILLPOINT_STAND_INS
  geometry/gauss_rule_without_gpl.cpp base/special_functions_without_gpl.cpp base/stop_request.cpp base/work_apart.cpp
  linalg/cholesky_without_gpl.cpp linalg/lu_without_gpl.cpp linalg/sparse_cholesky.cpp linalg/sparse_lu.cpp)

if(NOT STILLPOINT_GPL)
  find_path(STILLPOINT_BOOST boost/math/special_functions/lambert_w.hpp REQUIRED)  # libboost-dev: headers alone
  message(STATUS "Without the libraries under the GPL: no gsl:<stepper> integrators, and mass.kind = \"multigrid\" will "
    "be refused; factors of matrices are made by Eigen, which takes longer")
endif()
