#include "base/quiet_gsl.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <gsl/gsl_errno.h>

#include "base/special_functions.hpp"

using namespace stillpoint;

TEST_CASE("a program's own handler of GSL's errors is there again afterwards, however many were quiet at once") {
  const auto own = [](const char*, const char*, int, int) {};
  gsl_error_handler_t* const before = gsl_set_error_handler(own);
  {
    const QuietGsl one;
    { const QuietGsl other; }
    CHECK(std::isnan(lambert_w(-1)));
  }
  CHECK(gsl_set_error_handler(before) == static_cast<gsl_error_handler_t*>(own));
}
