// Steps that go wrong: every integrator keeps the last good state and says what happened.
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "solvers/integrators/integrator_setup.hpp"

namespace {

using namespace stillpoint;
using test::for_each_way;
using test::Setup;
using Status = StepReport::Status;

TEST_CASE("an inadmissible trial is tried again with a smaller step", "[integrator]") {
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup setup(method.name, 0.1, rtol);
    setup.start();
    REQUIRE(setup.integrator->step(10).status == Status::ok);
    const StepReport usual = setup.integrator->step(10);
    const long rejected = setup.integrator->rejected_steps();
    bool failed = false;
    setup.chain.answer = false;
    setup.chain.trouble = [&](ConstVec, Vec) { return !std::exchange(failed, true); };
    const StepReport report = setup.integrator->step(10);
    CAPTURE(rtol.has_value());
    CHECK(report.status == Status::ok);
    CHECK(report.h < (rtol ? 0.1 : 0.51 * usual.h));
    CHECK(report.t == Approx(usual.t + report.h));
    CHECK(setup.integrator->rejected_steps() == rejected + 1);
    StepReport last = report;
    while (last.status == Status::ok && last.t < 1) last = setup.integrator->step(1);
    CHECK(last.t == 1);
  });
}

TEST_CASE("where no step is admissible the last good state is kept, and from there it goes on", "[integrator]") {
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup setup(method.name, 0.1, rtol);
    setup.start();
    const StepReport good = setup.integrator->step(10);
    REQUIRE(good.status == Status::ok);
    const std::vector<double> last_good = setup.values;
    setup.chain.answer = false;
    setup.chain.trouble = [](ConstVec, Vec) { return true; };
    for (int k = 0; k < 2; ++k) {
      const StepReport report = setup.integrator->step(10);
      CAPTURE(rtol.has_value(), report.message);
      CHECK(report.status == Status::inadmissible);
      CHECK(report.t == good.t);
      CHECK(setup.values == last_good);
      CHECK(!report.message.empty());
    }
    CHECK(setup.integrator->steps() == 1);
    setup.chain.trouble = nullptr;
    CHECK(setup.integrator->step(10).status == Status::ok);
    CHECK(setup.values != last_good);
  });
}

TEST_CASE("a state that is inadmissible at the start is reported by the first step", "[integrator]") {
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup setup(method.name, 0.1, rtol);
    setup.chain.answer = false;
    setup.chain.trouble = [](ConstVec, Vec) { return true; };
    const std::vector<double> initial = setup.values;
    setup.start();
    CHECK(setup.integrator->step(10).status == Status::inadmissible);
    CHECK(setup.values == initial);
  });
}

TEST_CASE("a force that is not a number never gets into the state", "[integrator]") {
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup setup(method.name, 0.1, rtol);
    setup.start();
    REQUIRE(setup.integrator->step(10).status == Status::ok);
    setup.chain.trouble = [](ConstVec, Vec R) {
      std::ranges::fill(R, std::numeric_limits<double>::quiet_NaN());
      return true;
    };
    // With a first-same-as-last table one more step is good: its last stage is the next one's first.
    std::vector<double> last_good;
    StepReport report;
    for (int k = 0; k < 3 && report.status == Status::ok; ++k) {
      last_good = setup.values;
      report = setup.integrator->step(10);
    }
    CAPTURE(rtol.has_value(), report.message);
    if (rtol) {
      CHECK((report.status == Status::not_finite || report.status == Status::failed));
    } else {
      CHECK(report.status == Status::not_finite);
    }
    CHECK(setup.values == last_good);
    CHECK(std::ranges::all_of(last_good, [](double value) { return std::isfinite(value); }));
  });
}

TEST_CASE("an unstable step is seen before the numbers overflow", "[integrator]") {
  for (const Method& method : methods()) {
    if (!method.fixed_step) continue;
    Setup setup(method.name, 50, {}, {.n = 3, .cubic = 1});
    setup.start();
    StepReport report;
    for (int k = 0; k < 3000 && report.status == Status::ok; ++k) report = setup.integrator->step(1e9);
    CAPTURE(method.name, report.message);
    CHECK((report.status == Status::not_finite || report.status == Status::inadmissible));
    CHECK(std::ranges::all_of(setup.values, [](double value) { return std::isfinite(value); }));
  }
}

TEST_CASE("an exception in the force passes through the C libraries as it is", "[integrator]") {
  struct Accident : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup setup(method.name, 0.1, rtol);
    setup.start();
    REQUIRE(setup.integrator->step(10).status == Status::ok);
    setup.chain.trouble = [](ConstVec, Vec) -> bool { throw Accident("the force broke"); };
    CHECK_THROWS_AS(setup.integrator->step(10), Accident);
    setup.chain.trouble = nullptr;
    CHECK(setup.integrator->step(10).status == Status::ok);
  });
}

}  // namespace

TEST_CASE("half a million fixed steps of ARKODE keep to the time that they are given", "[integrator]") {
  stillpoint::test::Setup setup("erk:rk4", 1e-3);
  setup.start();
  stillpoint::StepReport report;
  while (report.t < 500 && report.status == stillpoint::StepReport::Status::ok) report = setup.integrator->step(500);
  CAPTURE(report.message);
  CHECK(report.status == stillpoint::StepReport::Status::ok);
  CHECK(report.t == 500);
  CHECK(setup.integrator->steps() == 500'000);
}
