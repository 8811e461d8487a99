// UMATs of ours, compiled by a test as a user compiles them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "temporary_folder.hpp"

namespace stillpoint::test {

/// Compiles tests/umats/SOURCE, in Fortran or C by its ending, into a shared library of this name in the folder.
inline std::filesystem::path compiled_umat(const TemporaryFolder& folder, const std::string& source,
                                           const std::string& name, const std::string& options = "") {
  const auto library = folder.path() / (name + ".so");
  const bool is_fortran = source.ends_with(".f");
  const std::string line = std::string(is_fortran ? "gfortran -ffixed-line-length-none" : "gcc -w") +
                           " -O2 -shared -fPIC -I " STILLPOINT_TEST_DATA "/../include/stillpoint/umat " + options +
                           " -o " + library.string() + " " STILLPOINT_TEST_DATA "/umats/" + source + " -lm";
  if (std::system(line.c_str()) != 0) throw std::runtime_error("cannot be compiled: " + line);
  return library;
}

}  // namespace stillpoint::test
