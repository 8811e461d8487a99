#include <catch2/catch.hpp>
#include <unistd.h>

#include "simulation/verdict.hpp"

using namespace stillpoint;

TEST_CASE("a run is asked to end by its user or by its wall time, and whoever asked once is not asked again") {
  int questions = 0;
  EndRequest by_user(0, [&] { return ++questions == 3; });
  CHECK_FALSE(by_user.asked());
  CHECK_FALSE(by_user.asked());
  CHECK(by_user.status() == RunStatus::running);
  for (int again = 0; again < 3; ++again) CHECK(by_user.asked());
  CHECK(questions == 3);
  CHECK(by_user.status() == RunStatus::interrupted);

  EndRequest by_time(0.05, {});
  CHECK_FALSE(by_time.asked());
  usleep(60'000);
  CHECK(by_time.asked());
  CHECK(by_time.status() == RunStatus::time_limit);
  CHECK_THAT(by_time.reason(), Catch::Contains("of wall time reached stop.wall_time"));
  CHECK_FALSE(EndRequest(0, {}).asked());
}
