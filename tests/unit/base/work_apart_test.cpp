#include "base/work_apart.hpp"

#include <stdexcept>
#include <thread>

#include <catch2/catch.hpp>

#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"

using namespace stillpoint;

TEST_CASE("whom a computation asks is who started it last, and nobody once that is over") {
  CHECK_FALSE(may_be_stopped());
  const StopScope nobody_stops([] { return false; });
  CHECK_NOTHROW(heed_stop_request());
  {
    const StopScope stops([] { return true; });
    CHECK_THROWS_AS(heed_stop_request(), Stopped);
    const StopScope undisturbed({});
    CHECK_FALSE(may_be_stopped());
    CHECK_NOTHROW(heed_stop_request());
  }
  CHECK_NOTHROW(heed_stop_request());
  CHECK(may_be_stopped());
}

TEST_CASE("work that cannot be stopped is waited for, unless someone asks for the end") {
  const auto here = std::this_thread::get_id();
  std::thread::id where;
  work_apart([&] { where = std::this_thread::get_id(); });
  CHECK(where == here);
  const StopScope nobody_stops([] { return false; });
  work_apart([&] { where = std::this_thread::get_id(); });
  CHECK(where != here);
  CHECK_THROWS_WITH(work_apart([] { throw std::runtime_error("no memory"); }), "no memory");

  const StopScope stops([] { return true; });
  const Stopwatch watch;
  CHECK_THROWS_AS(work_apart([] { std::this_thread::sleep_for(std::chrono::seconds(2)); }), Stopped);
  CHECK(watch.seconds() < 1);
  CHECK(work_was_left());
}
