// What every integrator promises: landing, counting, starting again, allocating nothing, refusing bad options.
#include <stillpoint/integrator.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "allocation_count.hpp"
#include "linalg/sundials.hpp"
#include "missing_method.hpp"
#include "solvers/integrators/integrator_setup.hpp"

namespace {

using namespace stillpoint;
using test::for_each_way;
using test::is_missing;
using test::Setup;
using Status = StepReport::Status;

TEST_CASE("equal fixed steps land on every output time", "[integrator]") {
  for (const Method& method : methods()) {
    if (!method.fixed_step) continue;
    Setup setup(method.name, 0.03);
    setup.start();
    CAPTURE(method.name);
    double t = 0, first_h = 0;
    for (int output = 1; output <= 7; ++output) {
      const double t_stop = 0.1 * output;
      for (int k = 0; k < 4; ++k) {  // ⌈0.1/0.03⌉
        const StepReport report = setup.integrator->step(t_stop);
        REQUIRE(report.status == Status::ok);
        if (first_h == 0) first_h = report.h;
        CHECK(report.h == first_h);
        CHECK(report.t > t);
        t = report.t;
      }
      CHECK(t == t_stop);
    }
    CHECK(first_h == Approx(0.025));
    CHECK(setup.integrator->steps() == 28);
    CHECK(setup.integrator->rejected_steps() == 0);
  }
}

TEST_CASE("a step as long as the way is one step in spite of rounding", "[integrator]") {
  Setup setup("leapfrog", 0.1);
  setup.start(0.7);
  CHECK(setup.integrator->step(0.8).t == 0.8);  // 0.8 − 0.7 > 0.1
  CHECK(setup.integrator->step(0.9).t == 0.9);
  CHECK(setup.integrator->steps() == 2);
  CHECK_THROWS_AS(setup.integrator->step(0.9), std::invalid_argument);
}

TEST_CASE("adaptive steps land on t_stop and keep to the largest step", "[integrator]") {
  for (const Method& method : methods()) {
    if (!method.adaptive) continue;
    Setup setup(method.name, 0.11, 1e-4);
    setup.start();
    CAPTURE(method.name);
    double t = 0;
    for (const double t_stop : {1.0, 1.05, 3.0}) {
      while (t < t_stop) {
        const StepReport report = setup.integrator->step(t_stop);
        REQUIRE(report.status == Status::ok);
        CHECK(report.h <= 0.11 * (1 + 1e-12));
        CHECK(report.t - t == Approx(report.h).margin(1e-12));
        t = report.t;
      }
      CHECK(t == t_stop);
    }
  }
}

TEST_CASE("a fixed step costs the evaluations that its method says", "[integrator]") {
  for (const Method& method : methods()) {
    if (!method.fixed_step) continue;
    Setup setup(method.name, 0.05);
    setup.start();
    setup.integrator->step(5);
    const long before = setup.system.evaluations();
    for (int k = 0; k < 20; ++k) REQUIRE(setup.integrator->step(5).status == Status::ok);
    CAPTURE(method.name);
    CHECK(setup.system.evaluations() - before == 20 * method.evaluations_per_step);
    CHECK(before <= 1 + method.evaluations_per_step);
  }
}

TEST_CASE("starting again repeats the same bits", "[integrator]") {
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup setup(method.name, 0.1, rtol);
    const std::vector<double> initial = setup.values;
    const auto three_steps = [&] {
      setup.values = initial;
      setup.start();
      for (int k = 0; k < 3; ++k) REQUIRE(setup.integrator->step(10).status == Status::ok);
      return setup.values;
    };
    const std::vector<double> first = three_steps();
    setup.integrator->step(10);
    CHECK(three_steps() == first);
    CHECK(setup.integrator->steps() == 7);  // counts go on over starts
  });
}

TEST_CASE("the caller's own N_Vector and a view of memory give the same bits", "[integrator]") {
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup one(method.name, 0.1, rtol), two(method.name, 0.1, rtol);
    Vector owner = VectorSpace().view(two.values);
    Vector adopted = two.system.vectors().adopt(owner.handle());
    one.start();
    two.integrator->start(0, adopted);
    for (int k = 0; k < 5; ++k) one.integrator->step(10), two.integrator->step(10);
    CHECK(one.values == two.values);
  });
}

TEST_CASE("an adopted vector may be of SUNDIALS' own making, with its own operations", "[integrator]") {
  for_each_way([](const Method& method, std::optional<double> rtol) {
    Setup one(method.name, 0.1, rtol), two(method.name, 0.1, rtol);
    const SUNContext context = stillpoint::sundials::create_context();
    const NVectorHandle stock =
        N_VMake_Serial(static_cast<sunindextype>(two.values.size()), two.values.data(), context);
    {
      Vector adopted = two.system.vectors().adopt(stock);
      one.start();
      two.integrator->start(0, adopted);
      for (int k = 0; k < 5; ++k) one.integrator->step(10), two.integrator->step(10);
      // Norms round differently, and an adaptive step feels it.
      for (std::size_t i = 0; i < one.values.size(); ++i)
        CHECK(two.values[i] == Approx(one.values[i]).margin(rtol ? 1e-6 : 1e-12));
      two.integrator.reset();  // ARKODE's memory is of the adopted vector's context
    }
    N_VDestroy(stock);
    SUNContext closing = context;
    SUNContext_Free(&closing);
  });
}

TEST_CASE("the one-force schemes allocate nothing after their first step", "[integrator]") {
  for (const std::string method : {"leapfrog", "symplectic-euler"}) {
    for (const bool consistent : {false, true}) {
      for (const std::string strategy : {"none", "viscous", "identity", "cundall"}) {
        Setup setup(method, 0.1, {}, {.n = 30, .consistent = consistent}, strategy);
        setup.start();
        setup.integrator->step(10);
        const long before = test::allocation_count();
        for (int k = 0; k < 10; ++k) setup.integrator->step(10);
        const long allocated = test::allocation_count() - before;  // CAPTURE allocates too
        CAPTURE(method, consistent, strategy);
        CHECK(allocated == 0);
      }
    }
  }
  CHECK(test::allocation_count() > 0);
}

TEST_CASE("the right-hand side and a Runge-Kutta step allocate nothing after the first step", "[integrator]") {
  for (const std::string method : {"erk:rk4", "erk:dormand-prince-7-4-5", "gsl:rk4"}) {
    if (is_missing(method)) continue;
    Setup setup(method, 0.1);
    setup.start();
    setup.integrator->step(10);
    const long before = test::allocation_count();
    for (int k = 0; k < 10; ++k) setup.integrator->step(10);
    CHECK(test::allocation_count() == before);
  }
}

// For the oscillator u'' + rate u' + omega² u = 0 the step's map is found from [1; 0] and [0; 1].
TEST_CASE("a method's amplification is that of the step it takes", "[integrator]") {
  for (const Method& method : methods()) {
    if (!method.fixed_step) continue;
    for (const auto& [h, rate] : {std::pair{0.5, 0.0}, {0.5, 0.4}, {1.9, 0.1}, {2.5, 0.3}, {0.3, 5.0}}) {
      std::array<std::array<double, 2>, 2> columns{};
      for (std::size_t k = 0; k < 2; ++k) {
        Setup setup(method.name, h, {}, {.n = 1}, "viscous", rate);
        setup.values = {k == 0 ? 1.0 : 0.0, k == 0 ? 0.0 : 1.0};
        setup.start();
        REQUIRE(setup.integrator->step(h).status == Status::ok);
        columns[k] = {setup.values[0], setup.values[1]};
      }
      const double half_trace = (columns[0][0] + columns[1][1]) / 2;
      const double determinant = columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0];
      const double discriminant = half_trace * half_trace - determinant;
      const double radius = discriminant < 0 ? std::sqrt(determinant) : std::abs(half_trace) + std::sqrt(discriminant);
      CAPTURE(method.name, h, rate);
      CHECK(method.amplification(h, 1, rate) == Approx(radius).epsilon(1e-9));
    }
  }
}

TEST_CASE("unknown methods and options that do not fit are refused with a reason", "[integrator]") {
  CHECK_THROWS_WITH(find_method("leapfrgo"), Catch::Contains("leapfrgo") && Catch::Contains("leapfrog"));
  CHECK_THROWS_AS(find_method("erk:rk4", DampingTreatment::lagged), std::invalid_argument);
  CHECK_THROWS_AS(find_method("leapfrog", DampingTreatment::exact), std::invalid_argument);
  CHECK_THROWS_AS(find_method("symplectic-euler", DampingTreatment::averaged), std::invalid_argument);
  CHECK_THROWS_WITH(Setup("leapfrog", 0.1, 1e-4), Catch::Contains("error estimate"));
  CHECK_THROWS_WITH(Setup("erk:rk4", 0.1, 1e-4), Catch::Contains("error estimate"));
  if (STILLPOINT_HAS_GPL) CHECK_THROWS_WITH(Setup("gsl:msadams", 0.1), Catch::Contains("adaptive only"));
  CHECK_THROWS_WITH(Setup("leapfrog", 0), Catch::Contains("max_step"));
  CHECK_THROWS_WITH(Setup("leapfrog", std::numeric_limits<double>::infinity()), Catch::Contains("max_step"));
  if (STILLPOINT_HAS_GPL) CHECK_THROWS_WITH(Setup("gsl:rk4", 0.1, -1.0), Catch::Contains("rtol"));
  CHECK_THROWS_AS(
      Setup("symplectic-euler", 0.1, {}, {.n = 3, .consistent = true}, "identity", 0.3, DampingTreatment::exact),
      std::invalid_argument);
}

}  // namespace
