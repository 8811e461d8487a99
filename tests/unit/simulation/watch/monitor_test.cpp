#include "simulation/watch/monitor.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

using namespace stillpoint;

namespace {

const MonitorOptions options{.residual = 1e-3, .kinetic_energy = 1e-2, .dwell = 10, .end_time = 0, .steps = 0};

}  // namespace

TEST_CASE("equilibrium is declared only after residual and kinetic energy both held for the whole period") {
  Monitor monitor(options);
  CHECK(monitor.check_balance(0, 1, 5.0) == RunStatus::running);
  CHECK(monitor.check_balance(1, 1e-4, 1e-3) == RunStatus::running);
  CHECK(monitor.check_balance(6, 1e-4, 1e-3) == RunStatus::running);
  CHECK(monitor.check_balance(10.9, 1e-4, 1e-3) == RunStatus::running);
  CHECK(monitor.check_balance(11, 1e-4, 1e-3) == RunStatus::equilibrium);
  CHECK(monitor.reason().find("held for 10 s") != std::string::npos);
}

TEST_CASE("a kinetic energy is called small beside its peak only if it is") {
  MonitorOptions at_once = options;
  at_once.dwell = 0;
  Monitor creeping(at_once);
  CHECK(creeping.check_balance(0, 1e-4, 0.8e-22, 1) == RunStatus::equilibrium);
  CHECK(creeping.reason() ==
        "residual 0.0001 <= 0.001 and kinetic energy 8e-23 of the work, which is rounding, held for 0 s");
  Monitor resting(at_once);
  CHECK(resting.check_balance(0, 1e-4, 0, 1) == RunStatus::equilibrium);
  CHECK(resting.reason() == "residual 0.0001 <= 0.001 and nothing has moved, held for 0 s");
}

TEST_CASE("an iterate, which has no motion, is in equilibrium as soon as it is balanced, and no sooner") {
  Monitor monitor(options);
  CHECK(monitor.check_balance(0, 2e-3, 0, 1, true, std::nullopt, false) == RunStatus::running);
  CHECK(monitor.check_balance(1, 1e-4, 0, 1, false, std::nullopt, false) == RunStatus::running);  // loads still change
  CHECK(monitor.check_balance(2, 1e-4, 0, 1, true, std::nullopt, false) == RunStatus::equilibrium);
  CHECK(monitor.reason() == "residual 0.0001 <= 0.001");
}

TEST_CASE("a turning point, where the kinetic energy alone is small, is not equilibrium") {
  Monitor monitor(options);
  for (int k = 0; k < 100; ++k) CHECK(monitor.check_balance(k, 0.5, k % 2 == 0 ? 0.0 : 1.0) == RunStatus::running);
}

TEST_CASE("passing through balance at full speed is not equilibrium and starts the period anew") {
  Monitor monitor(options);
  CHECK(monitor.check_balance(0, 1e-4, 1.0) == RunStatus::running);   // at the peak of its kinetic energy
  CHECK(monitor.check_balance(5, 1e-4, 1e-4) == RunStatus::running);  // the period begins here
  CHECK(monitor.check_balance(12, 2e-3, 1e-4) == RunStatus::running);
  CHECK(monitor.check_balance(13, 1e-4, 1e-4) == RunStatus::running);
  CHECK(monitor.check_balance(22, 1e-4, 1e-4) == RunStatus::running);
  CHECK(monitor.check_balance(23, 1e-4, 1e-4) == RunStatus::equilibrium);
}

TEST_CASE("a residual limit of 0 switches the test for equilibrium off") {
  MonitorOptions off = options;
  off.residual = 0;
  Monitor monitor(off);
  for (int k = 0; k < 100; ++k) CHECK(monitor.check_balance(k, 0, 0) == RunStatus::running);
}

TEST_CASE("a residual that is not finite is divergence") {
  Monitor monitor(options);
  CHECK(monitor.check_balance(0, std::numeric_limits<double>::quiet_NaN(), 1) == RunStatus::diverged);
  Monitor energy(options);
  CHECK(energy.check_balance(0, 1, std::numeric_limits<double>::infinity()) == RunStatus::diverged);
}

TEST_CASE("each limit ends the run with its own status, and 0 is no limit") {
  MonitorOptions limits{.residual = 0, .kinetic_energy = 0, .dwell = 0, .end_time = 5, .steps = 100};
  CHECK(Monitor(limits).check_limits(5, 1) == RunStatus::end_time);
  CHECK(Monitor(limits).check_limits(1, 100) == RunStatus::step_limit);
  CHECK(Monitor(limits).check_limits(1, 1) == RunStatus::running);
  CHECK(Monitor(MonitorOptions{}).check_limits(1e9, 1'000'000'000) == RunStatus::running);
}

TEST_CASE("the state is asked for about sixteen times a period, not at every step") {
  Monitor monitor(options);
  int asked = 0;
  for (double t = 0.01; t < 10; t += 0.01) {
    if (!monitor.due(t)) continue;
    ++asked;
    monitor.check_balance(t, 1, 1);
  }
  CHECK(asked >= 14);
  CHECK(asked <= 16);
}

TEST_CASE("where a distance is asked for as well, residual and distance have both to hold for the whole period") {
  MonitorOptions both = options;
  both.distance = 1e-2;
  for (const bool near : {true, false}) {  // at 5, where the other is not yet as it should be
    Monitor monitor(both);
    CHECK(monitor.check_balance(0, 1, 5.0, 0, true, 1.0) == RunStatus::running);
    CHECK(monitor.check_balance(5, near ? 1e-2 : 1e-4, 1e-3, 0, true, near ? 1e-3 : 0.1) == RunStatus::running);
    CHECK(monitor.check_balance(6, 1e-4, 1e-3, 0, true, 1e-3) == RunStatus::running);  // the period begins here
    CHECK(monitor.check_balance(15.9, 1e-4, 1e-3, 0, true, 1e-3) == RunStatus::running);
    CHECK(monitor.check_balance(16, 1e-4, 1e-3, 0, true, 1e-3) == RunStatus::equilibrium);
    CHECK(monitor.reason().starts_with("residual 0.0001 <= 0.001 and distance 0.001 <= 0.01 and kinetic energy"));
  }
}

TEST_CASE("a distance alone is enough for equilibrium, and one that is not known is far") {
  MonitorOptions alone = options;
  alone.residual = 0;
  alone.distance = 1e-2;
  Monitor monitor(alone);
  CHECK(monitor.check_balance(0, 1, 0, 0, true, 1e-3) == RunStatus::running);
  CHECK(monitor.check_balance(10, 1, 0, 0, true, 1e-3) == RunStatus::equilibrium);
  Monitor unknown(alone);
  for (int k = 0; k < 100; ++k) CHECK(unknown.check_balance(k, 1e-12, 0) == RunStatus::running);
}

TEST_CASE("a distance is not asked for where it has no limit") {
  Monitor monitor(options);
  CHECK(monitor.check_balance(0, 1e-4, 0, 0, true, 1e9) == RunStatus::running);
  CHECK(monitor.check_balance(10, 1e-4, 0, 0, true, std::nullopt) == RunStatus::equilibrium);
}

TEST_CASE("no distance is near enough before the loads have come to their end") {
  MonitorOptions alone = options;
  alone.residual = 0;
  alone.distance = 1e-2;
  Monitor monitor(alone);
  for (int k = 0; k < 100; ++k) CHECK(monitor.check_balance(k, 0, 0, 0, false, 0.0) == RunStatus::running);
}

TEST_CASE("equilibrium that need not last is declared at the first moment in balance") {
  stillpoint::Monitor lasting({.residual = 1e-3, .dwell = 10}),
      at_once({.residual = 1e-3, .dwell = 10, .must_last = false});
  CHECK(lasting.check_balance(1, 1e-4, 0) == stillpoint::RunStatus::running);
  CHECK(at_once.check_balance(1, 1e-2, 0) == stillpoint::RunStatus::running);
  CHECK(at_once.check_balance(2, 1e-4, 0) == stillpoint::RunStatus::equilibrium);
  CHECK(at_once.reason() == "residual 0.0001 <= 0.001");
}

// The rate of a damping that finds itself is noise once the body is at rest.
TEST_CASE("no test is further away than a share of the run, and none has to last for more of it, whatever the period") {
  for (const double noise : {1e4, 1e10, 1e300}) {
    Monitor monitor(options);
    double declared = 0, last_check = 0;
    for (double t = 1; t < 1000 && declared == 0; t += 1) {
      if (!monitor.due(t)) continue;
      CHECK(t - last_check <= 1 + std::max(10.0, t) / 16);
      last_check = t;
      monitor.set_dwell(t < 50 ? 20 : noise, t);
      if (monitor.check_balance(t, t < 60 ? 1 : 1e-13, t < 60 ? 1 : 0) == RunStatus::equilibrium) declared = t;
    }
    CAPTURE(noise);
    CHECK(declared > 70);
    CHECK(declared <= 2 * 60 * 1.1);  // the body was in balance from 60 on
  }
}

TEST_CASE("a period that was seen is waited for") {
  Monitor monitor(options);
  monitor.set_dwell(20, 100);
  CHECK(monitor.check_balance(100, 1, 5.0) == RunStatus::running);
  CHECK(monitor.check_balance(101, 1e-4, 1e-3) == RunStatus::running);
  CHECK(monitor.check_balance(120, 1e-4, 1e-3) == RunStatus::running);
  CHECK(monitor.waits_for() == "in balance for 19 of 20 s");
  CHECK(monitor.check_balance(121, 1e-4, 1e-3) == RunStatus::equilibrium);
}

TEST_CASE("a body that creeps is in no equilibrium, whatever its residual and its kinetic energy") {
  const double endless = std::numeric_limits<double>::infinity();
  for (const double way : {0.1, endless, std::numeric_limits<double>::quiet_NaN()}) {
    Monitor monitor({.residual = 0.1, .kinetic_energy = 0.1, .dwell = 10});
    monitor.set_way_left(way, 5e-3);
    for (int k = 0; k < 100; ++k) CHECK(monitor.check_balance(k, 1e-12, k == 0 ? 1 : 0) == RunStatus::running);
    CHECK(monitor.waits_for() == (way == 0.1 ? "way left 0.1 > 0.005 of the displacement" : "a motion that dies out"));
    monitor.set_way_left(1e-3, 5e-3);
    CHECK(monitor.check_balance(100, 1e-12, 0) == RunStatus::running);  // for a period
    CHECK(monitor.check_balance(110, 1e-12, 0) == RunStatus::equilibrium);
    CHECK(monitor.reason().find("way left 0.001 <= 0.005") != std::string::npos);
  }
}
