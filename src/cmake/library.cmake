# add_stillpoint_library(TARGET [COMPILER-OPTION…]): the library, from the same sources each time that it is called.
function(add_stillpoint_library target)
  add_library(${target} ${STILLPOINT_SOURCES})
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME stillpoint VERSION ${PROJECT_VERSION} SOVERSION 0 UNITY_BUILD_MODE GROUP)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_definitions(${target}
    # Eigen aligns by the processor that it is compiled for. With -march=native in the library and not in a program that
    # links it, one would free what the other allocated in another way: both take the widest alignment instead.
    PUBLIC EIGEN_MAX_ALIGN_BYTES=64
    PRIVATE STILLPOINT_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target} PUBLIC Eigen3::Eigen PRIVATE stillpoint_flags ${STILLPOINT_DEPENDENCIES})
  target_compile_options(${target} PRIVATE ${ARGN})
  target_precompile_headers(${target} PRIVATE ${STILLPOINT_PRECOMPILED})
  # What a UMAT in a library of a user's own calls, it finds in the program that links this one.
  if(NOT BUILD_SHARED_LIBS)
    foreach(routine rotsig_ sinv_ sprinc_ sprind_ xit_)
      target_link_options(${target} INTERFACE "LINKER:--export-dynamic-symbol=${routine}")
    endforeach()
  endif()
  foreach(module multigrid ranks)
    if(TARGET stillpoint_${module})
      add_dependencies(${target} stillpoint_${module})  # whoever has the library finds the module
    endif()
  endforeach()

  if(BUILD_SHARED_LIBS)
    # Nobody replaces a function of the library by one of the same name: gcc may inline as in a program.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
  elseif(STILLPOINT_PYTHON)
    # The module is a shared object with the library inside. What nobody outside can replace is called and inlined as in
    # a program, so that the position-independent code is as fast.
    set_target_properties(${target} PROPERTIES
      POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
endfunction()

# With CMAKE_UNITY_BUILD, for what is built once, the files of a room are compiled as one; those of space/phase and
# the laws of each kinematics, which are large by themselves, stay apart.
foreach(source IN LISTS STILLPOINT_SOURCES)
  if(NOT source MATCHES point_material_ AND source MATCHES "/src/(.*)/[^/]*$" AND NOT CMAKE_MATCH_1 STREQUAL space/phase)
    string(MAKE_C_IDENTIFIER ${CMAKE_MATCH_1} group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endif()
endforeach()
set_source_files_properties(src/base/own_module.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON COMPILE_DEFINITIONS
  "STILLPOINT_LIBDIR=\"${CMAKE_INSTALL_LIBDIR}\";STILLPOINT_FULL_LIBDIR=\"${CMAKE_INSTALL_FULL_LIBDIR}\"")
set_source_files_properties(src/linalg/multigrid.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON COMPILE_DEFINITIONS
  "STILLPOINT_MULTIGRID_MODULE=\"${STILLPOINT_MULTIGRID_MODULE}\"")
set_source_files_properties(src/parallel/start_ranks.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON COMPILE_DEFINITIONS
  "STILLPOINT_RANKS_MODULE=\"${STILLPOINT_RANKS_MODULE}\"")
