// Integrators that a build without the libraries under the GPL has not.
#pragma once

#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <string_view>

#include <catch2/catch.hpp>

namespace stillpoint::test {

/// Whether a method of GSL is not there to test, as the program was built.
inline bool is_missing(std::string_view method) {
  if (!method.starts_with("gsl:")) return false;
  CHECK(STILLPOINT_HAS_GPL == std::ranges::any_of(methods(), [&](const Method& m) { return m.name == method; }));
  return !STILLPOINT_HAS_GPL;
}

}  // namespace stillpoint::test
