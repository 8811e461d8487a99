// FIRE and FIRE 2.0.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "solvers/relaxation/relaxing.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("one mass under FIRE moves as Bitzek's and Guénolé's algorithms write it", "[strategies]") {
  struct Variant {
    const char* name;
    double theta;
    int n_min;
    bool goes_back;
  };
  for (const Variant& variant : {Variant{"fire", 0.1, 5, false}, {"fire2", 0.25, 20, true}}) {
    Chain chain({.n = 1, .load = 1});
    Relaxing relaxing(chain, {.strategy = variant.name}, 0.9);
    double x = 0, v = 0, h = 0.05 * 0.9, theta = variant.theta;
    int downhill = 0, turns = 0;
    for (int step = 1; step <= 60; ++step) {
      const double F = 1 - x;
      if (step > 1 && v * F > 0) {
        if (++downhill > variant.n_min) {
          h = std::min(1.1 * h, 0.45);
          theta *= 0.99;
        }
      } else if (step > 1) {
        ++turns;
        downhill = 0;
        if (!variant.goes_back || step - 1 > variant.n_min) h /= 2;
        theta = variant.theta;
        if (variant.goes_back) x -= h / 2 * v;
        v = 0;
      }
      v += h * F;
      v = (1 - theta) * v + theta * std::abs(v) * (F > 0 ? 1 : -1);
      x += h * v;
      relaxing.step();
      CAPTURE(variant.name, step);
      REQUIRE(relaxing.y[0] == Approx(x).epsilon(1e-8));
    }
    CHECK(turns >= 2);
  }
}
