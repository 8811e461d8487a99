#include "simulation/watch/way_left.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

constexpr double small = 5e-3;

/// After n blocks of length 1 of a point that moves as u(t), beside one that stands at 1.
WayLeft after(int n, const std::function<double(double)>& u) {
  WayLeft way(small);
  way.begin(0);
  for (int k = 1; k <= n; ++k) {
    double mean = 0;
    constexpr int samples = 4;
    for (int i = 1; i <= samples; ++i) mean += u(k - 1 + static_cast<double>(i) / samples) / samples;
    way.add(k - 0.5, 2, std::vector<double>{0, 1, mean, 0});
  }
  return way;
}

}  // namespace

TEST_CASE("the way left of a motion that dies out exponentially is what is left of it") {
  for (const double tau : {3.0, 10.0, 100.0}) {
    for (const double age : {0.5, 2.0, 6.0}) {
      const int n = static_cast<int>(std::ceil(age * tau)) + 4;
      const double left = 2 * std::exp(-(n - 0.4) / tau);  // of a displacement that ends at 2
      const double relative = after(n, [&](double t) { return 2 * (1 - std::exp(-t / tau)); }).relative();
      CAPTURE(tau, age);
      CHECK(relative * (2 - left) >= 0.95 * left);
      // Nobody can tell it from one that dies out more slowly, before it has gone for much longer than τ.
      if (age > 5) CHECK(relative * (2 - left) <= 20 * left);
    }
  }
}

TEST_CASE("a motion that goes on, slows down like log t, or sets in has no end that could be told") {
  for (const int n : {8, 50, 1000}) {
    CAPTURE(n);
    CHECK(std::isinf(after(n, [](double t) { return 0.01 * t; }).relative()));
    CHECK(std::isinf(after(n, [](double t) { return 0.01 * t * t; }).relative()));
    CHECK(after(n, [](double t) { return std::log(1 + t); }).relative() > 1);
    const auto after_a_step = after(n, [n](double t) { return std::min(1.0, t) + 0.1 * t / n; });
    CHECK(after_a_step.relative() > 10 * small);
  }
  CHECK(std::abs(after(100, [](double t) { return 0.01 * t; }).exponent()) < 0.05);
}

// u = 1 − t^{−p}: a last block alone sees p/(p + 1) of what is left.
TEST_CASE("the way left of a motion that dies out by a power of time is not taken for that of an exponential") {
  for (const double p : {0.3, 0.5, 1.0, 2.0}) {
    for (const int n : {20, 200}) {
      const double left = std::pow(n, -p);
      const double relative = after(n, [&](double t) { return 1 - std::pow(1 + t, -p); }).relative();
      CAPTURE(p, n);
      CHECK(relative >= 0.8 * left);
      CHECK(relative <= 3 * left);
    }
  }
}

TEST_CASE("what swings about its rest by little is at rest, and by much is not") {
  const auto swings = [](double amplitude) {
    return after(40, [=](double t) { return 1 + amplitude * std::sin(2 * std::numbers::pi * 0.37 * t); });
  };
  CHECK(swings(5e-4).relative() <= small);
  CHECK(swings(0.2).relative() > small);
}

TEST_CASE("nothing is known before there are three blocks, and what never moved has no way left") {
  CHECK(std::isinf(after(2, [](double) { return 1.0; }).relative()));
  CHECK(after(3, [](double) { return 1.0; }).relative() == 0);
  WayLeft nothing(small);
  for (int k = 0; k < 5; ++k) nothing.add(k, 1, std::vector<double>{0, 0});
  CHECK(nothing.relative() == 0);
  WayLeft lost(small);
  for (int k = 0; k < 5; ++k) lost.add(k, 1, std::vector<double>{std::nan(""), 1});
  CHECK_FALSE(lost.relative() <= small);
}

TEST_CASE("loads that change begin it anew, and what was saved goes on with its bits") {
  WayLeft way = after(50, [](double t) { return 1 - std::exp(-t); });
  CHECK(way.relative() <= small);
  SavedState saved;
  way.archive(StateArchive::saving(saved));
  WayLeft again(small);
  again.archive(StateArchive::restoring(saved));
  for (WayLeft* one : {&way, &again}) one->add(50.5, 2, std::vector<double>{0, 1, 1.1, 0});
  CHECK(way.relative() == again.relative());
  CHECK(way.relative() > small);
  way.begin(51);
  CHECK(std::isinf(way.relative()));
}
