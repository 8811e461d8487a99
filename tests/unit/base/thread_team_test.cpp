#include "base/thread_team.hpp"

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "base/parallel_loop.hpp"

namespace stillpoint {
namespace {

// How often a loop of n has done each index.
std::vector<int> visits(std::size_t n, std::size_t parts_a_thread) {
  std::vector<int> count(n, 0);
  in_parts(n, parts_a_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++count[i];
  });
  return count;
}

TEST_CASE("a loop that threads share does each index once, for any number of threads and of parts") {
  const int threads = GENERATE(1, 2, 3, 8);
  const std::size_t parts = GENERATE(1U, 2U, 8U), n = GENERATE(0U, 1U, 2U, 17U, 1000U);
  const ThreadScope scope(threads);
  for (int again = 0; again < 200; ++again) CHECK(visits(n, parts) == std::vector<int>(n, 1));
}

TEST_CASE("a hundred thousand short loops, one after the other, lose nothing and do nothing twice") {
  const ThreadScope scope(3);
  std::vector<long> count(6, 0);
  constexpr long loops = 100'000;
  for (long loop = 0; loop < loops; ++loop) {
    in_parts(count.size(), 2, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++count[i];
    });
  }
  CHECK(count == std::vector<long>(count.size(), loops));
}

TEST_CASE("loops have threads of their own for each thread that calls them, and one alone within a part") {
  const ThreadScope scope(2);
  std::atomic<int> shared_again = 0, wrong = 0;
  in_parts(64, 8, [&](std::size_t begin, std::size_t end) {
    if (loop_threads() != 1) ++shared_again;
    for (std::size_t i = begin; i < end; ++i) wrong += visits(100, 4) != std::vector<int>(100, 1);
  });
  CHECK(shared_again == 0);
  CHECK(loop_threads() == 2);
  std::vector<std::jthread> callers;
  for (int k = 0; k < 3; ++k) {
    callers.emplace_back([&] {
      const ThreadScope scope_of_caller(2);
      for (int again = 0; again < 500; ++again) wrong += visits(100, 4) != std::vector<int>(100, 1);
    });
  }
  callers.clear();
  CHECK(wrong == 0);
}

TEST_CASE("what a part of a loop throws reaches the caller, once the other parts are done") {
  const ThreadScope scope(2);
  std::atomic<int> done = 0;
  const auto loop = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i, ++done)
      if (i == 63) throw std::runtime_error("part of " + std::to_string(i));
  };
  try {
    in_parts(64, 32, loop);
    FAIL("nothing was thrown");
  } catch (const std::runtime_error& error) {
    CHECK(std::string(error.what()) == "part of 63");
    CHECK(done == 63);
    CHECK(loop_threads() == 2);
  }
  CHECK(visits(100, 4) == std::vector<int>(100, 1));
}

TEST_CASE("a loop does not wait for threads that are not let run: after a fork, in which there are none, it ends") {
  const ThreadScope scope(3);
  REQUIRE(visits(100, 4) == std::vector<int>(100, 1));
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    alarm(20);  // ends a child that waits
    _exit(visits(100, 4) == std::vector<int>(100, 1) ? 0 : 1);
  }
  int status = -1;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("sums have the same bits for any number of threads") {
  std::vector<double> x(100'003);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1.0 / static_cast<double>(3 * i + 1);
  const auto sum = [&](int threads) {
    const ThreadScope scope(threads);
    return sum_over(x.size(), [&](std::size_t i) { return x[i]; });
  };
  const double alone = sum(1);
  CHECK(alone > 0);
  for (const int threads : {2, 3, 7}) CHECK(sum(threads) == alone);
}

}  // namespace
}  // namespace stillpoint
