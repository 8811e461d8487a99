# A package is built for every processor of its architecture, and the loops over points want the widest vectors that one
# has. So the shared library is built again for each of STILLPOINT_INSTRUCTION_SETS, into folders in which the dynamic
# loader looks first, widest first, for those that the processor has (ld.so(8), "glibc-hwcaps"):
#   lib/libstillpoint.so.0   lib/glibc-hwcaps/x86-64-v3/libstillpoint.so.0   …
# The command and the Python module are built once; they link the first, and get the widest.
if(STILLPOINT_INSTRUCTION_SETS AND NOT (BUILD_SHARED_LIBS AND NOT STILLPOINT_NATIVE))
  message(FATAL_ERROR "STILLPOINT_INSTRUCTION_SETS needs BUILD_SHARED_LIBS=ON and STILLPOINT_NATIVE=OFF")
endif()
foreach(set IN LISTS STILLPOINT_INSTRUCTION_SETS)
  add_stillpoint_library(stillpoint_${set} -march=${set})
  set_target_properties(stillpoint_${set} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/glibc-hwcaps/${set})
  install(TARGETS stillpoint_${set}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/glibc-hwcaps/${set} COMPONENT library NAMELINK_SKIP)
endforeach()
