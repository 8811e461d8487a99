// What every integrator promises: landing, counting, keeping the last good state, carrying what goes wrong.
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "allocation_count.hpp"
#include "chain.hpp"
#include "sundials_compat.hpp"

namespace {

using namespace stillpoint;
using Status = StepReport::Status;

/// A chain whose force can be made to fail: `trouble` is asked before every evaluation.
class TroubledChain : public test::Chain {
 public:
  using Chain::Chain;
  std::function<bool(ConstVec u, Vec R)> trouble;  // true: R is set, or the trial refused, by trouble itself
  bool answer = true;                              // what internal_force then returns

  bool internal_force(double t, ConstVec u, Vec R) const override {
    if (trouble && trouble(u, R)) return answer;
    return Chain::internal_force(t, u, R);
  }
};

/// A chain, its damping, its state and one integrator on it.
struct Setup {
  explicit Setup(const std::string& method, double h, std::optional<double> rtol = {},
                 test::ChainOptions chain_options = {.n = 3}, const std::string& strategy = "viscous", double c = 0.3,
                 DampingTreatment treatment = DampingTreatment::automatic)
      : chain(std::move(chain_options)),
        damping(make_damping(strategy, c, 0.5)),
        system(chain, *damping),
        values(2 * chain.size()),
        y(system.vectors().view(values)) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1 * std::sin(1.0 + static_cast<double>(i));
    IntegratorOptions options;
    options.method = method;
    options.treatment = treatment;
    options.max_step = h;
    options.rtol = rtol;
    options.atol_u = options.atol_v = 1e-6;
    integrator = make_integrator(options, system);
  }
  void start(double t = 0) { integrator->start(t, y); }

  TroubledChain chain;
  std::unique_ptr<Damping> damping;
  RelaxationSystem system;
  std::vector<double> values;
  Vector y;
  std::unique_ptr<Integrator> integrator;
};

/// Each method in each way that it can step.
void for_each_way(const std::function<void(const Method&, std::optional<double> rtol)>& test) {
  for (const Method& method : methods()) {
    CAPTURE(method.name);
    if (method.fixed_step) test(method, {});
    if (method.adaptive) test(method, 1e-4);
  }
}

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
  CHECK_THROWS_WITH(Setup("gsl:msadams", 0.1), Catch::Contains("adaptive only"));
  CHECK_THROWS_WITH(Setup("leapfrog", 0), Catch::Contains("max_step"));
  CHECK_THROWS_WITH(Setup("leapfrog", std::numeric_limits<double>::infinity()), Catch::Contains("max_step"));
  CHECK_THROWS_WITH(Setup("gsl:rk4", 0.1, -1.0), Catch::Contains("rtol"));
  CHECK_THROWS_AS(
      Setup("symplectic-euler", 0.1, {}, {.n = 3, .consistent = true}, "identity", 0.3, DampingTreatment::exact),
      std::invalid_argument);
}

}  // namespace
