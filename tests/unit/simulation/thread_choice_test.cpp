#include "simulation/thread_choice.hpp"

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

/// Steps a run for `seconds` on a machine where a step takes step(threads, now); the share of the steps' work, each as
/// long as with one thread, that was done: 1 is one thread's speed.
template <class Step>
double speed(ThreadChoice& choice, double seconds, const Step& step) {
  double now = 0, work = 0;
  while (now < seconds) {
    const double took = step(choice.threads(), now);
    work += step(1, now);
    now += took;
    choice.observe(took);
  }
  return work / now;
}

}  // namespace

TEST_CASE("alone on a machine a run takes all threads, but for the moments in which it tries one") {
  for (const double one : {1e-5, 1e-3, 0.03}) {
    CAPTURE(one);
    ThreadChoice choice(0, 2);
    CHECK(speed(choice, 60, [one](int threads, double) { return threads == 1 ? one : 0.55 * one; }) > 0.98 / 0.55);
    CHECK(choice.usual() == 2);
  }
}

TEST_CASE("beside a program that keeps a core busy a run is hardly slower than with one thread") {
  for (const double slower : {1.2, 4.0, 15.0}) {
    for (const double one : {1e-5, 3e-4, 5e-3}) {
      CAPTURE(slower, one);
      ThreadChoice choice(0, 2);
      CHECK(speed(choice, 60, [=](int threads, double) { return threads == 1 ? one : slower * one; }) > 0.96);
      CHECK(choice.usual() == 1);
    }
  }
}

TEST_CASE("a program that comes and goes is noticed: never much slower than one thread, soon quick again") {
  ThreadChoice choice(0, 4);
  const auto step = [](int threads, double now) {
    const bool busy = now > 10 && now < 30;
    return threads == 1 ? 1e-3 : (busy ? 8e-3 : 0.3e-3);
  };
  const double alone = 1 / 0.3;
  CHECK(speed(choice, 60, step) > 0.85 * (40 * alone + 20) / 60);
}

TEST_CASE("where more threads are no gain there is one") {
  ThreadChoice choice(0, 2);
  speed(choice, 10, [](int, double) { return 1e-5; });
  CHECK(choice.threads() == 1);
  CHECK(choice.usual() == 1);
  ThreadChoice only(0, 1);
  CHECK(only.threads() == 1);
}

TEST_CASE("a number of threads that was asked for is taken from the first step on, and while it is quicker than one") {
  ThreadChoice choice(3, 2);
  CHECK(choice.usual() == 3);
  for (int step = 0; step < 50; ++step) {
    CHECK(choice.threads() == 3);
    choice.observe(1e-3);
  }
  CHECK(speed(choice, 60, [](int threads, double) { return threads == 1 ? 1e-3 : 0.98e-3; }) > 1);
  CHECK(choice.usual() == 3);
  ThreadChoice one(1, 2);
  CHECK(speed(one, 1, [](int threads, double) { return threads == 1 ? 1e-3 : 1e-4; }) == Approx(1));
  CHECK(one.usual() == 1);
}

TEST_CASE("threads that were asked for and hurt are left after a tenth of a second, until they do not") {
  ThreadChoice choice(2, 2);
  const auto step = [](int threads, double now) { return threads == 1 ? 1e-3 : (now < 10 ? 8e-3 : 0.55e-3); };
  CHECK(speed(choice, 10, step) > 0.96);
  CHECK(choice.usual() == 1);
  CHECK(speed(choice, 60, [&](int threads, double) { return step(threads, 20); }) > 0.8 / 0.55);
}
