# The module that calls MPI, loaded if a launcher has started several copies of the program: nobody else waits for MPI.
# STILLPOINT_RANKS_MODULE: its file name; empty: there is none. STILLPOINT_MPI, STILLPOINT_MPI_INCLUDE: MPI itself.
set(STILLPOINT_RANKS_MODULE "")
find_path(STILLPOINT_MPI_INCLUDE mpi.h PATH_SUFFIXES openmpi/include openmpi mpich HINTS
  /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/openmpi/include)
find_library(STILLPOINT_MPI mpi)
if(STILLPOINT_MPI_INCLUDE AND STILLPOINT_MPI)
  add_library(stillpoint_ranks MODULE src/parallel/mpi_ranks.cpp)
  set_target_properties(stillpoint_ranks PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_include_directories(stillpoint_ranks PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
  target_include_directories(stillpoint_ranks SYSTEM PRIVATE ${STILLPOINT_MPI_INCLUDE})
  target_compile_definitions(stillpoint_ranks PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)  # bindings that nobody asks for
  target_link_libraries(stillpoint_ranks PRIVATE stillpoint_flags fmt::fmt ${STILLPOINT_MPI})
  install(TARGETS stillpoint_ranks LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/stillpoint COMPONENT ranks)
  set(STILLPOINT_RANKS_MODULE stillpoint_ranks.so)
else()
  message(STATUS "MPI (libopenmpi-dev) is not found: a run will be of one process")
endif()
