#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "simulation/loads/formula_samples.hpp"
#include "simulation/loads/load_schedule.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;

namespace {

double largest(const std::string& formula, double end) {
  const Expression f(formula, {}, "t");
  double most = 0;
  for (const double t : moments_of_change(f, {}, 1000, end)) most = std::max(most, std::abs(f({}, t)));
  return most;
}

// When the loads of a bar have done what they do, by the scene.
double settled_from(const std::string& load, double end) {
  const Scene scene =
      load_scene(STILLPOINT_PROBLEMS "/bar.toml",
                 {fmt::format("force[0].value='{}'", load), fmt::format("stop.time={}", end), "stop.residual=1e-6"});
  const auto phase = make_phase(scene);
  const LoadSchedule schedule(scene, *phase, end);
  constexpr double long_after = 1e7;
  double from = 0, to = end > 0 ? end : long_after;
  if (schedule.settled(0)) return 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = (from + to) / 2;
    (schedule.settled(middle) ? to : from) = middle;
  }
  return to;
}

}  // namespace

TEST_CASE("pulses of a millionth of the run are found by where their comparisons switch or their functions bend") {
  for (const char* pulse : {"(t>=3000)*(t<3000.004)", "t>1234.5 && t<1234.501 ? 1 : 0", "max(0, 1-abs(t-777.77)/0.002)",
                            "(abs(t-3999.5)<1e-3)", "max(0, 1-((t-2000.123)/0.001)^2)", "(t*t>=9e6)*(t*t<9e6+6)",
                            "(sin(t/100)>0.99999999)"}) {
    CAPTURE(pulse);
    CHECK(largest(pulse, 4000) > 0.5);
  }
}

TEST_CASE("loads have settled after their last pulse, however short, to a thousandth of it") {
  CHECK(settled_from("0.001+0.001*(t>=30)*(t<30.0001)", 40) == Approx(30.0001).margin(1e-7));
  CHECK(settled_from("0.001*min(t/5,1)*(1-(t>35.5)*(t<35.50005))", 40) == Approx(35.50005).margin(1e-7));
  CHECK(settled_from("0.001*(1+max(0,1-abs(t-20)/1e-4))", 40) == Approx(20.0001).margin(1e-7));
  CHECK(settled_from("0.001*min(t/5,1)", 40) == Approx(5).margin(1e-6));  // a change of 1e-9 counts as none
  CHECK(settled_from("0.001", 40) == 0);
}

TEST_CASE("steps as at random, in step with any raster, have not settled before the end") {
  // A raster of 20 000 moments in 4 s meets each zero of sin(5000 pi t).
  CHECK(settled_from("0.001*(1+(sin(5000*pi*t)>0.5))", 4) > 3.99);
  CHECK(settled_from("0.001*(1+(sin(1e6*t)>0))", 40) > 39.9);
  CHECK(settled_from("0.001*(1+(sin(1e6*t)>0.999999))", 40) > 39.9);
  CHECK(settled_from("0.001*(1+(sin(1e6*t)*sin(3e5*t+1)<-0.9999))", 40) > 39.9);
  CHECK(settled_from("0.001*(1+rint(0.45+0.1*sin(1e6*t)))", 40) > 39.9);
}

TEST_CASE("what is switched as at random and then left out has settled when it is left out") {
  CHECK(settled_from("0.001*(1+(sin(1e6*t)>0.999999)*(t<7))", 40) == Approx(7).epsilon(1e-3));
}

TEST_CASE("a run without an end waits for the last change of loads that settle, early, late or short") {
  CHECK(settled_from("0.001+0.001*(t>=149.6)", 0) == Approx(149.6).epsilon(1e-7));
  CHECK(settled_from("0.001+0.001*(t>=12345)*(t<12345.01)", 0) == Approx(12345.01).epsilon(1e-9));
  CHECK(settled_from("0.001*min(t/500,1)", 0) == Approx(500).epsilon(1e-6));
  CHECK(settled_from("0.001*(1-exp(-t/3))", 0) == Approx(3 * std::log(1e9)).epsilon(0.01));  // a billionth is left
  CHECK(settled_from("0.001*(1+0*t)", 0) == 0);
}

TEST_CASE("loads that never settle leave a run without an end open, those that do and steady ones do not") {
  const auto is_open = [](const char* load) {
    const Scene scene = load_scene(STILLPOINT_PROBLEMS "/bar.toml",
                                   {fmt::format("force[0].value='{}'", load), "stop.time=0", "stop.residual=1e-6"});
    return LoadSchedule(scene, *make_phase(scene), 0).is_open();
  };
  for (const char* load : {"1e-9*t", "0.001*sin(t)", "0.001*(sin(t)>0.5)", "0.001*sqrt(4-t)", "0.001*log(1+t)"}) {
    CAPTURE(load);
    CHECK(is_open(load));
  }
  for (const char* load : {"0.001", "0.001*min(t/5,1)", "0.001*(t>3)*(t<1e6)", "0.001*tanh(t)"}) {
    CAPTURE(load);
    CHECK_FALSE(is_open(load));
  }
}
