# How our own files are compiled, kept in one interface target, and what they link.
add_library(stillpoint_flags INTERFACE)
target_compile_options(stillpoint_flags INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Wno-sign-conversion  # which clang has in -Wconversion, and gcc has not
  $<$<BOOL:${STILLPOINT_WERROR}>:-Werror>
  # The few floating-point flags that keep non-finite values visible and results the same bits:
  # errno of sqrt and friends is never read, and no trap handler is installed, so both only free the vectoriser.
  -fno-math-errno -fno-trapping-math
  $<$<BOOL:${STILLPOINT_NATIVE}>:-march=native>
  $<$<CONFIG:Release>:-O3>
  # GCC tidies its memory up from 128 MB on, again and again: a tenth of a large file's time, for a gigabyte saved.
  "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1500000;SHELL:--param ggc-min-expand=100>"
  # What gcc 12 guesses from the code that -O3 has inlined is wrong, inside its own <string> and AVX-512 headers. So
  # is what it guesses of an std::optional in the asan build.
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>"
  "$<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:\
-Wno-uninitialized;-Wno-maybe-uninitialized;-Wno-restrict>"
  # The loops over a block of points are asked to be vectorised, which gcc does and clang 14 cannot: slower, not wrong.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>
  # Files that are compiled as one look like headers, in which nothing nameless should stand.
  $<$<AND:$<BOOL:${CMAKE_UNITY_BUILD}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)

# What src/base/inlining.hpp and some tests ask for. gcc's own __SANITIZE_ADDRESS__ is lost with a precompiled header, and
# clang has none.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=")
  target_compile_definitions(stillpoint_flags INTERFACE STILLPOINT_SANITIZED)
endif()

find_package(CLI11 CONFIG REQUIRED)  # of the command alone
set(STILLPOINT_DEPENDENCIES
  fmt::fmt muparser::muparser tomlplusplus::tomlplusplus nlohmann_json::nlohmann_json OpenMP::OpenMP_CXX
  ZLIB::ZLIB Qhull::qhull_r SUNDIALS::arkode SUNDIALS::nvecserial stillpoint::arpack stillpoint::hdf5)
if(STILLPOINT_GPL)
  list(APPEND STILLPOINT_DEPENDENCIES GSL::gsl stillpoint::cholmod stillpoint::umfpack)
endif()

# What most files include and none of us changes is compiled once: half the time of the build.
set(STILLPOINT_PRECOMPILED
  <algorithm> <array> <cmath> <filesystem> <functional> <memory> <optional> <random> <span> <string> <vector>
  <Eigen/SparseCore> <fmt/format.h>)

# ccache, if it is there, remembers what the compiler made. It keeps precompiled headers only if it is told that nothing
# here depends on __TIME__, on the age of a header, or on macros that a precompiled header does not use.
find_program(STILLPOINT_CCACHE ccache)
if(STILLPOINT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${STILLPOINT_CCACHE})
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
endif()
