// Runs that are independent of each other, on so many threads.
#include "study/side_by_side.hpp"

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <omp.h>

using namespace stillpoint;

TEST_CASE("each of n runs is made once and on one thread, however many threads share them") {
  for (const int threads : {1, 3, 20}) {
    CAPTURE(threads);
    std::vector<std::atomic<int>> made(7);
    std::atomic<int> most = 0;
    side_by_side(threads, made.size(), [&](std::size_t k) {
      ++made[k];
      most = std::max(most.load(), omp_get_max_threads());
    });
    for (const auto& count : made) CHECK(count == 1);
    CHECK(most == 1);
  }
  side_by_side(2, 0, [](std::size_t) { FAIL("there is none"); });
}

TEST_CASE("of several runs that fail the first in their order is reported, once all the others are done") {
  for (const int threads : {1, 3}) {
    CAPTURE(threads);
    std::atomic<int> done = 0;
    CHECK_THROWS_WITH(side_by_side(threads, 9,
                                   [&](std::size_t k) {
                                     if (k % 3 == 2) throw std::runtime_error(std::to_string(k));
                                     ++done;
                                   }),
                      "2");
    CHECK(done == 6);
  }
}
