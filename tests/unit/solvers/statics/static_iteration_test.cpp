// What cg and lbfgs do where points remember, and where the whole load is too much at once.
#include <stillpoint/state_norms.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "scenes.hpp"
#include "solvers/statics/static_methods.hpp"
#include "temporary_folder.hpp"
#include "way_to_rest.hpp"
#include "yielding_block.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

/// A spring of stiffness 1 that tells forces only as far as `reach` from what it last remembered, and carries no more
/// than `strength`.
class Reluctant : public test::Chain {
 public:
  Reluctant(double load, double reach, double strength = 1e9)
      : Chain({.n = 1, .load = load}), reach_(reach), strength_(strength) {
    history_dependent_ = true;
  }

  std::vector<double> remembered;  // u of every commit

  std::unique_ptr<TrialState> make_trial() const override { return std::make_unique<Trial>(); }
  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
    trial.t = t;
    static_cast<Trial&>(trial).u = u[0];
    R[0] = std::min(u[0], strength_);
    return std::abs(u[0] - last()) <= reach_;
  }
  void commit(TrialState& trial) override { remembered.push_back(static_cast<Trial&>(trial).u); }

 private:
  struct Trial : TrialState {
    double u = 0;
  };
  double last() const { return remembered.empty() ? 0 : remembered.back(); }

  double reach_, strength_;
};

struct Ended {
  double u;
  std::string failure;
};
Ended iterate(SemiDiscrete& system, const std::string& method, int load_steps = 1) {
  const auto damping = no_damping();
  RelaxationSystem relaxing(system, *damping);
  const auto solver =
      make_static_method({.name = method, .max_step = 1, .tolerance = 1e-9, .load_steps = load_steps}, relaxing);
  Vector y = VectorSpace().make(2);
  solver->start(0, y);
  std::string failure;
  for (int k = 0; k < 1000 && failure.empty() && !(StateNorms(relaxing).last_residual() <= 1e-9); ++k) {
    const StepReport report = solver->step(1e9);
    if (report.status != StepReport::Status::ok) failure = report.message + "!";
  }
  return {y.span()[0], failure};
}

}  // namespace

TEST_CASE("a static iteration is one implicit increment of the law, committed at its end", "[strategies]") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("block.toml", test::yielding_block);
  std::vector<double> u_y;
  for (const std::string strategy : {"cg", "lbfgs"}) {
    const Summary summary = run(load_scene(file, {test::override_of(strategy)}));
    CAPTURE(strategy, summary.reason, summary.rhs_evaluations);
    CHECK(summary.status == RunStatus::equilibrium);
    CHECK(scenes::probe(summary, "middle", "stress.yy") == Approx(-28).epsilon(0.2));  // 0 had it not been committed
    u_y.push_back(scenes::probe(summary, "middle", "u.y"));
  }
  // The increment has one solution; motions, which commit on their way, end 1e-4 beside it, each elsewhere.
  CHECK(u_y[0] == Approx(u_y[1]).epsilon(1e-6));
  const Summary moving = run(load_scene(file, {"damping.strategy=kinetic"}));
  CHECK(scenes::probe(moving, "middle", "u.y") == Approx(u_y[0]).epsilon(1e-2));
  CHECK(scenes::probe(moving, "middle", "u.y") != Approx(u_y[0]).epsilon(1e-5));
}

TEST_CASE("an increment of the load that the line search cannot follow is halved until it can, each remembered") {
  for (const char* method : {"cg", "lbfgs"}) {
    CAPTURE(method);
    Reluctant system(/*load=*/1, /*reach=*/0.3);
    const Ended end = iterate(system, method);
    CHECK(end.failure.empty());
    CHECK(std::abs(end.u - 1) <= 1e-9);
    REQUIRE(system.remembered.size() >= 3);  // and the run commits the last one
    CHECK(std::ranges::is_sorted(system.remembered));
    CHECK(std::abs(system.remembered.front() - 0.25) <= 1e-8);  // 1, ½, ¼ of the load
  }
}

TEST_CASE("equal shares of the load are remembered one after the other") {
  for (const char* method : {"cg", "lbfgs"}) {
    CAPTURE(method);
    Reluctant system(/*load=*/1, /*reach=*/10);
    const Ended end = iterate(system, method, 5);
    CHECK(std::abs(end.u - 1) <= 1e-9);
    REQUIRE(system.remembered.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(std::abs(system.remembered[k] - 0.2 * static_cast<double>(k + 1)) <= 1e-8);
  }
}

TEST_CASE("a load that nothing can carry fails with the load factor that was reached") {
  for (const char* method : {"cg", "lbfgs"}) {
    CAPTURE(method);
    Reluctant system(/*load=*/2, /*reach=*/10, /*strength=*/1);
    const Ended end = iterate(system, method);
    CHECK_THAT(end.failure, Contains("no equilibrium beyond the load factor 0.49") ||
                                Contains("no equilibrium beyond the load factor 0.5:"));
    CHECK(end.u <= 1 + 1e-9);  // what it had in equilibrium is kept
    CHECK(end.u >= 0.98);
  }
}

TEST_CASE("laws remember each step of a march, and of a static solver the end alone") {
  const auto damping = no_damping();
  Vector y = VectorSpace().make(2);
  const auto take_step = [&y](Stepper& stepper) {
    stepper.start(0, y);
    stepper.accept(0);
    const StepReport report = stepper.step(1e9);
    REQUIRE(report.status == StepReport::Status::ok);
    stepper.accept(report.t);
    return report.t;
  };
  for (const char* method : {"cg", "lbfgs"}) {
    CAPTURE(method);
    Reluctant system(/*load=*/1, /*reach=*/10);
    RelaxationSystem relaxing(system, *damping);
    const auto solver = make_static_method({.name = method, .max_step = 1, .tolerance = 1e-9}, relaxing);
    const double t = take_step(*solver);
    CHECK_FALSE(solver->moves());
    CHECK(system.remembered.empty());
    solver->finish(t);
    CHECK(system.remembered == std::vector{y.span()[0]});
  }
  Reluctant system(/*load=*/1, /*reach=*/10);
  RelaxationSystem relaxing(system, *damping);
  const auto march = make_integrator({.max_step = 0.1}, relaxing);
  std::ranges::fill(y.span(), 0.0);
  const double t = take_step(*march);
  CHECK(march->moves());
  march->finish(t);
  CHECK(system.remembered == std::vector{0.0, y.span()[0]});
}
