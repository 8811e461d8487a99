# How our own files are compiled, kept in one interface target, and what they link.
add_library(stillpoint_flags INTERFACE)
target_compile_options(stillpoint_flags INTERFACE
  -Wall -Wextra -Wconversion -Wshadow
  $<$<BOOL:${STILLPOINT_WERROR}>:-Werror>
  # The few floating-point flags that keep non-finite values visible and results the same bits:
  # errno of sqrt and friends is never read, and no trap handler is installed, so both only free the vectoriser.
  -fno-math-errno -fno-trapping-math
  $<$<BOOL:${STILLPOINT_NATIVE}>:-march=native>
  $<$<CONFIG:Release>:-O3>)

find_package(CLI11 CONFIG REQUIRED)  # of the command alone
set(STILLPOINT_DEPENDENCIES
  fmt::fmt muparser::muparser tomlplusplus::tomlplusplus nlohmann_json::nlohmann_json OpenMP::OpenMP_CXX
  GSL::gsl SUNDIALS::arkode SUNDIALS::nvecserial stillpoint::cholmod stillpoint::umfpack
  stillpoint::arpack stillpoint::hdf5)
