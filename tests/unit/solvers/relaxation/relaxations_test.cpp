// Damping strategies that own their iteration: what they cost on chains whose answers are known, and where they lead.
//
// The Chebyshev estimate for a linear system of condition number κ is ½ √κ ln(2/ε) force evaluations.
#include <stillpoint/spectrum.hpp>
#include <stillpoint/state_norms.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <omp.h>

#include "allocation_count.hpp"
#include "chain.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "scenes.hpp"
#include "simulation/setup/model.hpp"
#include "statics.hpp"
#include "temporary_folder.hpp"
#include "way_to_rest.hpp"

namespace {

using namespace stillpoint;
using Values = std::vector<double>;

const std::vector<std::string> iterations = {"kinetic",   "adaptive", "papadrakakis", "fire",  "fire2",
                                             "chebyshev", "nesterov", "cg",           "lbfgs", "auto"};

/// A chain with a load of its own on each mass.
class LoadedChain final : public test::Chain {
 public:
  LoadedChain(test::ChainOptions options, Values loads) : Chain(std::move(options)), loads_(std::move(loads)) {}
  void external_force(double /*t*/, ConstVec /*u*/, Vec F) const override {
    std::copy(loads_.begin(), loads_.end(), F.begin());
  }

 private:
  Values loads_;
};

/// 156 equal masses held at both ends under a uniform load: κ = 9989.
test::ChainOptions long_chain() { return {.n = 156, .left_held = true, .right_held = true, .load = 1e-4}; }

/// u with R(u) = F, by Newton's method.
Values static_solution(const SemiDiscrete& system) {
  Values u(system.size()), Q(system.size()), R(system.size());
  for (int iteration = 0; iteration < 50; ++iteration) {
    system.external_force(0, u, Q);
    system.internal_force(0, u, R, *system.make_trial());
    for (std::size_t i = 0; i < u.size(); ++i) Q[i] -= R[i];
    SparseCholesky(system.tangents().matrix(Tangent::consistent, 0, u)).solve(Q, Q);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += Q[i];
  }
  return u;
}

double lower_bound(double kappa, double accuracy) { return 0.5 * std::sqrt(kappa) * std::log(2 / accuracy); }

struct Way {
  std::string strategy;
  double step_fraction = 0.9;
  double c = 0, alpha = 0.2;
  RelaxationOptions options{};
  std::string method = "leapfrog";
};

/// Force evaluations until ‖u − u*‖ ≤ accuracy ‖u*‖, most + 1 if that does not come.
long evaluations_to(double accuracy, SemiDiscrete& system, const Values& solution, double omega_max, const Way& way,
                    long most = 100'000) {
  const auto damping = test::damping_of(way.strategy, way.c, way.alpha);
  RelaxationSystem relaxation(system, *damping);
  IntegratorOptions options;
  options.method = way.method;
  options.max_step = way.step_fraction * 2 / omega_max;
  const auto integrator = test::stepper_of(way.strategy, options, relaxation, way.options);
  Values y(2 * system.size());
  Vector state = relaxation.vectors().view(y);
  integrator->start(0, state);
  double scale = 0;
  for (const double u : solution) scale += u * u;
  while (relaxation.evaluations() <= most) {
    double error = 0;
    for (std::size_t i = 0; i < solution.size(); ++i) error += std::pow(y[i] - solution[i], 2);
    if (error <= accuracy * accuracy * scale) return relaxation.evaluations();
    const StepReport step = integrator->step(1e9);
    INFO(way.strategy << ": " << step.message);
    REQUIRE(step.status == StepReport::Status::ok);
  }
  return most + 1;
}

long evaluations_of(const test::Chain& like, const Way& way, double accuracy = 1e-6) {
  test::Chain chain(like.options());
  return evaluations_to(accuracy, chain, static_solution(chain), chain.exact_omega(chain.size()), way);
}

/// What auto spends with no frequency given: force evaluations and applications of K.
long auto_spends(SemiDiscrete& system, const Values& solution) {
  const FrequencyEstimate found = omega_max_by_lanczos(system, 0, Values(system.size()));
  REQUIRE(found.converged);
  const Way way = {.strategy = "auto", .step_fraction = 0.95};
  return found.iterations + evaluations_to(1e-6, system, solution, found.omega, way);
}
/// The same in a scene, which compares physical mass and Gershgorin's as well.
long auto_spends(const Model& model, const Values& solution) {
  const Way way = {.strategy = "auto", .step_fraction = 1};
  return model.tangent_applications + evaluations_to(1e-6, *model.phase, solution, 2 / model.integrator.max_step, way);
}

double kappa_of(const SemiDiscrete& system) {
  const Values u(system.size());
  return std::pow(omega_max_by_arpack(system, 0, u).omega / omega_1_by_arpack(system, 0, u).omega, 2);
}

TEST_CASE("Chebyshev's semi-iteration costs the Chebyshev estimate, 726 evaluations to 1e-6 at kappa = 9989",
          "[strategies]") {
  const test::Chain chain(long_chain());
  const long cost = evaluations_of(
      chain, {.strategy = "chebyshev", .step_fraction = 1, .options = {.omega_1 = chain.exact_omega(1)}});
  CHECK(cost == Approx(726).epsilon(0.05));
  CHECK(static_cast<double>(cost) < 1.01 * lower_bound(9989, 1e-6));
}

TEST_CASE("leapfrog with c = 2 omega_1 at 0.9 of the critical step costs 927 evaluations to 1e-6", "[strategies]") {
  const test::Chain chain(long_chain());
  CHECK(evaluations_of(chain, {.strategy = "viscous", .c = 2 * chain.exact_omega(1)}) == Approx(927).epsilon(0.05));
}

TEST_CASE("kinetic damping with the half-step correction costs 309 evaluations to 1e-6 on the uniform load",
          "[strategies]") {
  const test::Chain chain(long_chain());
  CHECK(evaluations_of(chain, {.strategy = "kinetic"}) == Approx(309).epsilon(0.05));
}

TEST_CASE("the parabolic place of the peak takes another third off", "[strategies]") {
  const test::Chain chain(long_chain());
  const long half_step = evaluations_of(chain, {.strategy = "kinetic"});
  const long parabolic = evaluations_of(chain, {.strategy = "kinetic", .options = {.peak = Peak::parabolic}});
  CHECK(parabolic == Approx(211).epsilon(0.05));
  CHECK(static_cast<double>(parabolic) < 0.7 * static_cast<double>(half_step));
}

TEST_CASE("Cundall's damping with alpha = 0.2 costs about 3260 evaluations to 1e-6, whatever rounding does",
          "[strategies]") {
  // D jumps with the sign of each v_i, and rounding grows to the size of the error itself in 500 steps: loads that only
  // differ in scale end up to 15 % apart.
  double sum = 0;
  const Values loads = {1, 1e-4, 1.1, 1.3, 3.7, 0.123, 0.77, 2.9, 0.31, 5.3};
  for (const double load : loads) {
    test::ChainOptions options = long_chain();
    options.load = load;
    const auto cost = static_cast<double>(evaluations_of(test::Chain(options), {.strategy = "cundall"}));
    CHECK(cost == Approx(3260).epsilon(0.25));
    sum += cost;
  }
  CHECK(sum / static_cast<double>(loads.size()) == Approx(3260).epsilon(0.12));
}

TEST_CASE("every other strategy costs what it did when it was written, to 5 %", "[strategies]") {
  const test::Chain chain(long_chain());
  const auto costs = [&](const Way& way) { return evaluations_of(chain, way); };
  CHECK(costs({.strategy = "adaptive"}) == Approx(942).epsilon(0.05));
  CHECK(costs({.strategy = "adaptive", .options = {.quotient = Quotient::diagonal}}) == Approx(937).epsilon(0.05));
  CHECK(costs({.strategy = "papadrakakis"}) == Approx(850).epsilon(0.05));
  CHECK(costs({.strategy = "fire"}) == Approx(612).epsilon(0.05));
  CHECK(costs({.strategy = "fire2"}) == Approx(640).epsilon(0.05));
  CHECK(costs({.strategy = "nesterov"}) == Approx(980).epsilon(0.05));
  CHECK(costs({.strategy = "combined", .step_fraction = 0.9 / std::sqrt(1.8), .alpha = 0.8}) ==
        Approx(4816).epsilon(0.05));
}

TEST_CASE("conjugate gradients end after 78 steps of two evaluations: the load meets 78 of the chain's 156 modes",
          "[strategies]") {
  const test::Chain chain(long_chain());
  CHECK(evaluations_of(chain, {.strategy = "cg"}, 1e-9) == Approx(157).margin(3));
  CHECK(evaluations_of(chain, {.strategy = "lbfgs"}, 1e-6) < 350);
}

TEST_CASE("auto takes the steps of conjugate gradients for one evaluation each, whatever step it is given first",
          "[strategies]") {
  const test::Chain chain(long_chain());
  for (const double share : {0.1, 0.9, 3.0}) {
    const Way way = {.strategy = "auto", .step_fraction = share, .options = {.linear = true}};
    CAPTURE(share);
    CHECK(evaluations_of(chain, way, 1e-9) == Approx(79).margin(2));  // 78 modes, and the one at rest
  }
}

TEST_CASE("the out-of-balance force that auto has found on its way is that of its iterate, down to rounding",
          "[strategies]") {
  for (const double cubic : {0.0, 1e3}) {  // linear, and stiffening
    test::ChainOptions chain_options = long_chain();
    chain_options.cubic = cubic;
    const test::Chain chain(chain_options);
    test::Chain again(chain_options);
    const auto damping = test::damping_of("auto", 0, 0);
    test::Chain system(chain_options);
    RelaxationSystem relaxation(system, *damping), fresh(again, *damping);
    IntegratorOptions options;
    options.max_step = 0.9;
    const auto integrator = test::stepper_of("auto", options, relaxation, {.linear = cubic == 0});
    Values y(2 * system.size());
    Vector state = relaxation.vectors().view(y), Q = relaxation.vectors().make(system.size());
    integrator->start(0, state);
    const double load = chain_options.load * std::sqrt(static_cast<double>(chain_options.n));
    double least = load;
    for (int k = 0; k < 5000 && !integrator->moves() && least > 1e-12 * load; ++k) {
      const StepReport step = integrator->step(1e9);
      REQUIRE(step.status == StepReport::Status::ok);
      REQUIRE(fresh.out_of_balance(step.t, first_half(ConstVec(y)), Q.span()));
      const auto known = integrator->known().unbalanced_force;
      if (!known) break;
      CAPTURE(cubic, k);
      CHECK(*known == Approx(norm(Q)).epsilon(1e-9).margin(1e-13 * load));
      CHECK(*known / relaxation.force_scale() == Approx(StateNorms(fresh).last_residual()).epsilon(1e-9).margin(1e-13));
      least = norm(Q);
    }
    CHECK(least < 1e-9 * load);  // it came that far by such steps
  }
}

TEST_CASE("auto ends after as many steps as a short chain has modes, though its residual falls by all digits at once",
          "[strategies]") {
  for (std::size_t n = 1; n <= 12; ++n) {
    const test::Chain chain({.n = n, .stiffness = 3, .load = 1e-3});
    test::Chain system(chain.options());
    const long evaluations = evaluations_to(1e-12, system, static_solution(chain), 2 * std::sqrt(3),
                                            {.strategy = "auto", .options = {.linear = true}});
    CAPTURE(n);
    CHECK(evaluations <= static_cast<long>(n) + 3);  // the start, and one beyond the last iterate
  }
  for (const std::size_t n : {3u, 5u, 7u, 10u}) {  // masses from 0.1 to 10: some steps more, as rounding counts
    Values masses, loads;
    for (std::size_t i = 0; i < n; ++i) {
      masses.push_back(std::pow(10.0, std::sin(static_cast<double>(i))));
      loads.push_back(std::sin(17.0 * static_cast<double>(i * i)));
    }
    const LoadedChain chain({.n = n, .masses = masses}, loads);
    LoadedChain system({.n = n, .masses = masses}, loads);
    const double omega_max = 2 / std::sqrt(std::ranges::min(masses));
    CAPTURE(n);
    CHECK(evaluations_to(1e-11, system, static_solution(chain), omega_max,
                         {.strategy = "auto", .options = {.linear = true}}) <= static_cast<long>(n) + 6);
  }
}

TEST_CASE("auto learns the lowest frequency that its load drives, and keeps quiet before it knows", "[strategies]") {
  class Oscillators final : public test::Chain {  // ω² = 1, and 199 from 100 to 199
   public:
    explicit Oscillators(double load_on_slowest) : Chain({.n = 200}), load_on_slowest_(load_on_slowest) {}
    static double squared(std::size_t i) { return i == 0 ? 1 : 99.5 + 0.5 * static_cast<double>(i); }
    void external_force(double, ConstVec, Vec F) const override {
      for (std::size_t i = 0; i < F.size(); ++i) F[i] = i == 0 ? load_on_slowest_ : 1;
    }
    bool internal_force(double, ConstVec u, Vec R, TrialState&) const override {
      for (std::size_t i = 0; i < R.size(); ++i) R[i] = squared(i) * u[i];
      return true;
    }

   private:
    double load_on_slowest_;
  };
  for (const double load : {1.0, 1e-3, 0.0}) {
    Oscillators system(load);
    const auto damping = test::damping_of("auto", 0, 0);
    RelaxationSystem relaxation(system, *damping);
    IntegratorOptions options;
    options.max_step = 0.9 * 2 / std::sqrt(199.0);
    const auto integrator = test::stepper_of("auto", options, relaxation, {.linear = true});
    Values y(2 * system.size());
    Vector state = relaxation.vectors().view(y);
    integrator->start(0, state);
    CHECK_FALSE(integrator->lowest_frequency());
    const double exact = std::sqrt(Oscillators::squared(load > 0 ? 0 : 1));
    CAPTURE(load);
    for (int k = 0; k < 16; ++k) {
      REQUIRE(integrator->step(1e9).status == StepReport::Status::ok);
      const auto known = integrator->lowest_frequency();
      if (known) CHECK(*known <= 1.02 * exact);
    }
    REQUIRE(integrator->lowest_frequency());
    CHECK(*integrator->lowest_frequency() == Approx(exact).epsilon(5e-3));
  }
}

TEST_CASE("a force that is not finite ends a step of auto, though the system has let it pass", "[strategies]") {
  class Breaking final : public test::Chain {
   public:
    using Chain::Chain;
    bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
      Chain::internal_force(t, u, R, trial);
      if (u[0] != 0) R[1] = std::numeric_limits<double>::infinity();
      return true;
    }
  };
  Breaking chain({.n = 3, .load = 1});
  const auto damping = test::damping_of("auto", 0, 0);
  RelaxationSystem relaxation(chain, *damping);
  IntegratorOptions options;
  options.max_step = 0.9;
  const auto integrator = test::stepper_of("auto", options, relaxation, {.linear = true});
  Values y(6);
  Vector state = relaxation.vectors().view(y);
  integrator->start(0, state);
  CHECK(integrator->step(1e9).status == StepReport::Status::not_finite);
  CHECK(y == Values(6, 0.0));  // the last good state
}

TEST_CASE("auto costs no more than lbfgs where the stiffness changes", "[strategies]") {
  for (const double cubic : {1.0, 1e2, 1e4}) {
    test::ChainOptions options = long_chain();
    options.n = 40, options.cubic = cubic;
    const test::Chain chain(options);
    CAPTURE(cubic);
    CHECK(evaluations_of(chain, {.strategy = "auto"}) <= evaluations_of(chain, {.strategy = "lbfgs"}));
  }
}

TEST_CASE("auto needs at most 1.15 times the evaluations of the best matrix-free way, on elastic scenes of every kind",
          "[strategies]") {
  for (const std::string scene : {"chain", "bar", "column", "cylinder", "mms_bar", "block", "neo_hookean_bar",
                                  "incompressible", "ladder/column", "ladder/mms_square", "ladder/compaction"}) {
    const auto evaluations_of_run = [&](const std::string& strategy) {
      const Summary summary = run(scenes::load(scene, {"solve.method=relaxation", test::override_of(strategy)}));
      CAPTURE(scene, strategy, summary.reason);
      CHECK(summary.status == RunStatus::equilibrium);
      return static_cast<double>(summary.rhs_evaluations);
    };
    double best = evaluations_of_run("kinetic");
    if (scene != "ladder/compaction")  // in phases
      best = std::min({best, evaluations_of_run("cg"), evaluations_of_run("lbfgs")});
    CAPTURE(scene, best);
    CHECK(evaluations_of_run("auto") <= 1.15 * best);
  }
}

TEST_CASE("auto stays where nothing but rounding is left", "[strategies]") {
  for (const bool linear : {true, false}) {
    test::Chain chain(long_chain());
    const Values solution = static_solution(chain);
    const auto damping = test::damping_of("auto", 0, 0);
    RelaxationSystem system(chain, *damping);
    IntegratorOptions options;
    options.max_step = 0.9 * 2 / chain.exact_omega(chain.size());
    const auto integrator = test::stepper_of("auto", options, system, {.linear = linear});
    Values y(2 * chain.size());
    Vector state = system.vectors().view(y);
    integrator->start(0, state);
    for (int k = 0; k < 5000; ++k) {
      REQUIRE(integrator->step(1e9).status == StepReport::Status::ok);
      if (k < (linear ? 90 : 500)) continue;  // 78 modes, and some steps for rounding
      double error = 0;
      for (std::size_t i = 0; i < solution.size(); ++i) error = std::max(error, std::abs(y[i] - solution[i]));
      CAPTURE(linear, k);
      REQUIRE(error <= 1e-9 * solution[chain.size() / 2]);
    }
  }
}

TEST_CASE("auto moves on from where the stiffness is negative, and ends where it is positive", "[strategies]") {
  test::Chain chain({.n = 8, .stiffness = -1, .cubic = 1, .load = 0.01});  // stable at extensions past 1/√3
  const auto damping = test::damping_of("auto", 0, 0);
  RelaxationSystem system(chain, *damping);
  IntegratorOptions options;
  options.max_step = 0.2;
  const auto integrator = test::stepper_of("auto", options, system);
  Values y(2 * chain.size());
  Vector state = system.vectors().view(y);
  integrator->start(0, state);
  bool moved = false, settled = false;
  for (int k = 0; k < 5000 && !settled; ++k) {
    REQUIRE(integrator->step(1e9).status == StepReport::Status::ok);
    moved = moved || integrator->moves();
    settled = !integrator->moves() && StateNorms(system).last_residual() < 1e-10;
  }
  CHECK(moved);
  CHECK(settled);
  for (std::size_t i = 0; i < chain.size(); ++i) CHECK(std::abs(y[i] - (i > 0 ? y[i - 1] : 0)) > 1 / std::sqrt(3.0));
}

TEST_CASE("auto has a motion only where loads vary, another phase may follow, or points remember or touch",
          "[strategies]") {
  const auto moves = [](const RelaxationOptions& relaxing) {
    test::Chain chain({.load = 1});
    const auto damping = test::damping_of("auto", 0, 0);
    RelaxationSystem system(chain, *damping);
    IntegratorOptions options;
    options.max_step = 0.5;
    return test::stepper_of("auto", options, system, relaxing)->moves();
  };
  CHECK_FALSE(moves({}));
  CHECK(moves({.steady = false}));
  CHECK(moves({.single_phase = false}));
  const auto scene_moves = [](const std::string& name, std::vector<std::string> set = {}) {
    set.emplace_back("damping.strategy=auto");
    return Simulation(scenes::load(name, set), {.records = false}).stepper().moves();
  };
  CHECK_FALSE(scene_moves("block"));
  CHECK(scene_moves("footing"));
  CHECK(scene_moves("block_on_wall", {"stop.residual=1e-6", "stop.time=0"}));
  CHECK(scene_moves("ladder/compaction"));
  CHECK(scene_moves("hard/load_that_changes"));
}

TEST_CASE(
    "on linear scenes leapfrog with c = 2 omega_1 at 0.95 of the critical step costs 1.3 Chebyshev estimates at most, "
    "and auto, which is told nothing, 1.6",
    "[strategies]") {
  const auto check = [](SemiDiscrete& system, double kappa, const Model* model = nullptr) {
    const Values solution = static_solution(system), rest(system.size());
    const double bound = lower_bound(kappa, 1e-6), omega_1 = omega_1_by_arpack(system, 0, rest).omega;
    const double omega_max = omega_max_by_arpack(system, 0, rest).omega;
    const long viscous = evaluations_to(1e-6, system, solution, omega_max,
                                        {.strategy = "viscous", .step_fraction = 0.95, .c = 2 * omega_1});
    const long itself = model ? auto_spends(*model, solution) : auto_spends(system, solution);
    INFO("kappa " << kappa << ", bound " << bound << ", c = 2 omega_1 " << viscous << ", auto " << itself);
    CHECK(static_cast<double>(viscous) <= 1.3 * bound);
    CHECK(static_cast<double>(itself) <= 1.6 * bound);
  };
  SECTION("a chain held at both ends under a uniform load") {
    test::Chain chain(long_chain());
    check(chain, kappa_of(chain));
  }
  SECTION("a chain of unequal masses with a free end that is pulled at two places") {
    std::mt19937 random(7);
    Values masses(70), loads(70);
    for (double& m : masses) m = 0.7 + 0.6 * static_cast<double>(random()) / 4294967296.0;
    loads[69] = 1, loads[20] = -3;
    LoadedChain chain({.masses = masses}, loads);
    const double kappa = kappa_of(chain);
    CHECK(kappa == Approx(1e4).epsilon(0.2));
    check(chain, kappa);
  }
  SECTION("a plane block that is bent and stretched") {
    const test::TemporaryFolder folder;
    const Scene scene = load_scene(folder.write("block.toml", R"(dim = 2
[grid]
min = [0, 0]
max = [2, 1]
cells = [20, 10]
[body]
material = "steel"
points_per_cell = 4
[material.steel]
law = "linear-elastic"
E = 1.0
nu = 0.3
rho = 1.0
[[support]]
face = "left"
[[traction]]
face = "right"
value = [1e-3, 5e-4]
[body_force]
value = [0, -1e-4]
[damping]
strategy = "auto"
[stop]
residual = 1e-6
)"));
    const Model model = make_model(scene);
    const double kappa = kappa_of(*model.phase);
    CHECK(kappa == Approx(1e4).epsilon(0.2));
    CHECK(model.tangent_applications == 24);
    check(*model.phase, kappa, &model);
  }
}

TEST_CASE("every strategy leads to the static solution of a linear, a stiffening and a consistent-mass chain",
          "[strategies]") {
  struct Case {
    const char* name;
    test::ChainOptions options;
  };
  const std::vector<double> masses = {1, 2, 0.5, 1.5, 1, 3, 1, 0.7, 1, 1, 2, 1};
  for (const Case& c : {Case{"linear", {.masses = masses, .load = 0.1}},
                        {"cubic", {.cubic = 0.4, .masses = masses, .right_held = true, .load = 0.1}},
                        {"consistent", {.masses = masses, .consistent = true, .load = 0.1}}}) {
    test::Chain chain(c.options);
    const Values solution = static_solution(chain);
    const double omega_max = omega_max_by_arpack(chain, 0, solution).omega;
    for (const std::string& strategy : iterations) {
      const double omega_1 = 0.9 * omega_1_by_arpack(chain, 0, Values(chain.size())).omega;
      CAPTURE(c.name, strategy);
      CHECK(evaluations_to(1e-10, chain, solution, omega_max,
                           {.strategy = strategy,
                            .step_fraction = strategy == "chebyshev" ? 1 : 0.9,
                            .options = {.omega_1 = omega_1}},
                           20'000) < 20'000);
    }
    const Way combined = {.strategy = "combined", .step_fraction = 0.9 / std::sqrt(1.7), .alpha = 0.7};
    CHECK(evaluations_to(1e-10, chain, solution, omega_max, combined, 50'000) < 50'000);
  }
}

TEST_CASE(
    "every strategy relaxes a neo-Hookean bar to its equilibrium, with physical mass and scaled by Gershgorin's "
    "bound",
    "[strategies]") {
  std::vector<std::string> all = iterations;
  all.push_back("combined");
  for (const std::string& strategy : all) {
    for (const bool scaled : {false, true}) {
      std::vector<std::string> set = {test::override_of(strategy), "stop.residual=1e-9", "stop.steps=50000"};
      if (scaled) set.insert(set.end(), {"mass.kind=lumped", "mass.scaling=gershgorin"});
      const Summary summary = run(scenes::load("neo_hookean_bar", set));
      CAPTURE(strategy, scaled, summary.reason, summary.rhs_evaluations);
      CHECK(summary.status == RunStatus::equilibrium);
      CHECK((catalogue().static_method(strategy) ? summary.method : summary.damping) == strategy);
      REQUIRE(summary.error);
      CHECK(summary.error->u_rel_l2 < 1e-7);
    }
  }
}

TEST_CASE("adapted damping is reported as the c in force, and that of strategies without one as none", "[strategies]") {
  const auto c_of = [](const std::string& strategy) {
    return run(scenes::load("neo_hookean_bar", {test::override_of(strategy)})).c;
  };
  const Summary summary = run(scenes::load("neo_hookean_bar"));
  for (const std::string strategy : {"adaptive", "papadrakakis"}) {
    const auto c = c_of(strategy);
    REQUIRE(c);
    CHECK(*c == Approx(2 * *summary.omega_1).epsilon(0.6));
  }
  CHECK_FALSE(c_of("kinetic"));
  CHECK_FALSE(c_of("cg"));
}

TEST_CASE("kinetic damping by ARKODE's root finding relaxes to the static solution, with fixed and adaptive steps",
          "[strategies]") {
  test::Chain chain({.n = 20, .cubic = 0.2, .right_held = true, .load = 0.01});
  const Values solution = static_solution(chain);
  for (const std::string method : {"erk:rk4", "erk:sofroniou-spaletta-5-3-4", "erk:fehlberg-6-4-5"}) {
    CAPTURE(method);
    const long cost = evaluations_to(1e-8, chain, solution, 2, {.strategy = "kinetic", .method = method}, 20'000);
    CHECK(cost < 20'000);
    if (method != "erk:rk4") continue;
    // Without the halts the motion would go on for ever.
    CHECK(evaluations_to(1e-8, chain, solution, 2, {.strategy = "none", .method = method}, 20'000) > 20'000);
  }
  const Summary adaptive =
      run(scenes::load("neo_hookean_bar", {"damping.strategy=kinetic", "integrator.method=erk:dormand-prince-7-4-5",
                                           "integrator.rtol=1e-5", "stop.residual=1e-8"}));
  CAPTURE(adaptive.reason);
  CHECK(adaptive.status == RunStatus::equilibrium);
  REQUIRE(adaptive.error);
  CHECK(adaptive.error->u_rel_l2 < 1e-6);
}

TEST_CASE("ARKODE halts the motion where its kinetic energy is largest: an oscillator stops at its rest position",
          "[strategies]") {
  test::Chain chain({.n = 1, .load = 1});
  const auto damping = test::damping_of("kinetic", 0, 0);
  RelaxationSystem system(chain, *damping);
  IntegratorOptions options;
  options.method = "erk:rk4";
  options.max_step = 0.05;
  const auto integrator = test::stepper_of("kinetic", options, system);
  Values y = {0, 0};
  Vector state = system.vectors().view(y);
  integrator->start(0, state);
  double t = 0;
  do {
    const StepReport step = integrator->step(10);
    REQUIRE(step.status == StepReport::Status::ok);
    t = step.t;
  } while (y[1] != 0);
  CHECK(t == Approx(std::numbers::pi / 2).epsilon(1e-5));  // u = 1 − cos t
  CHECK(y[0] == Approx(1).epsilon(1e-5));
}

TEST_CASE("strategies give the same bits for any number of threads", "[strategies]") {
  const auto steps_with = [](const std::string& strategy, int threads) {
    omp_set_num_threads(threads);
    test::Chain chain({.n = 20'000, .cubic = 0.5, .right_held = true, .load = 0.01});
    const auto damping = test::damping_of(strategy, 0, 0.5);
    RelaxationSystem system(chain, *damping);
    IntegratorOptions options;
    options.max_step = 0.9;
    const auto integrator = test::stepper_of(strategy, options, system, {.omega_1 = 0.1});
    Values y(2 * chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) y[i] = 0.01 * std::sin(0.3 * static_cast<double>(i));
    Vector state = system.vectors().view(y);
    integrator->start(0, state);
    for (int k = 0; k < 40; ++k) REQUIRE(integrator->step(1e6).status == StepReport::Status::ok);
    return y;
  };
  const int before = omp_get_max_threads();
  for (const std::string& strategy : iterations) {
    CAPTURE(strategy);
    CHECK(steps_with(strategy, 1) == steps_with(strategy, 3));
  }
  omp_set_num_threads(before);
}

TEST_CASE("a step of a strategy allocates nothing", "[strategies]") {
  for (const bool consistent : {false, true}) {
    for (const std::string& strategy : iterations) {
      test::Chain chain({.n = 40, .consistent = consistent, .load = 0.01});
      const auto damping = test::damping_of(strategy, 0, 0);
      RelaxationSystem system(chain, *damping);
      IntegratorOptions options;
      options.max_step = 0.5;
      const auto integrator = test::stepper_of(strategy, options, system, {.omega_1 = 0.03});
      Values y(2 * chain.size());
      Vector state = system.vectors().view(y);
      integrator->start(0, state);
      integrator->step(1e6);
      const long before = test::allocation_count();
      for (int k = 0; k < 30; ++k) integrator->step(1e6);
      const long allocated = test::allocation_count() - before;
      CAPTURE(strategy, consistent);
      CHECK(allocated == 0);
    }
  }
}

TEST_CASE("one mass under FIRE moves as Bitzek's and Guénolé's algorithms write it", "[strategies]") {
  struct Variant {
    const char* name;
    double theta;
    int n_min;
    bool goes_back;
  };
  for (const Variant& variant : {Variant{"fire", 0.1, 5, false}, {"fire2", 0.25, 20, true}}) {
    test::Chain chain({.n = 1, .load = 1});
    const auto damping = test::damping_of(variant.name, 0, 0);
    RelaxationSystem system(chain, *damping);
    IntegratorOptions options;
    options.max_step = 0.9;
    const auto integrator = test::stepper_of(variant.name, options, system);
    Values y = {0, 0};
    Vector state = system.vectors().view(y);
    integrator->start(0, state);
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
      REQUIRE(integrator->step(1e9).status == StepReport::Status::ok);
      CAPTURE(variant.name, step);
      REQUIRE(y[0] == Approx(x).epsilon(1e-8));
    }
    CHECK(turns >= 2);
  }
}

TEST_CASE(
    "combined damping acts in full where the force falls and not at all where it grows with the motion "
    "[FLAC, combined damping]",
    "[strategies]") {
  const auto damping = test::damping_of("combined", 0, 0.8);
  const Values v = {1, 1, -1, -1, 0}, last = {20, 5, 20, 5, 10};
  Values Q = {10, 10, 10, 10, 10};
  damping->add_local_since(v, last, Q);
  const Values expected = {2, 10, 10, 18, 10};
  for (std::size_t i = 0; i < 5; ++i) CHECK(Q[i] == Approx(expected[i]));
  CHECK(damping->stiffness_factor() == Approx(1.8));
}

TEST_CASE("Lanczos finds omega_max to 1 % by twelve applications of K", "[strategies]") {
  for (const bool consistent : {false, true}) {
    for (const std::size_t n : {5, 40, 156, 1000}) {
      test::Chain chain({.n = n, .right_held = true, .consistent = consistent});
      const Values rest(n);
      const FrequencyEstimate bound = omega_max_by_lanczos(chain, 0, rest);
      const double exact = omega_max_by_arpack(chain, 0, rest).omega;
      CAPTURE(n, consistent, bound.status);
      CHECK(bound.omega == Approx(exact).epsilon(0.01));
      CHECK(bound.iterations <= 12);
    }
  }
}

/// A block that is held at its base and pressed from above and from the side, until it yields.
const std::string yielding_block = R"(dim = 2
[grid]
min = [0, 0]
max = [2, 1]
cells = [8, 4]
[body]
material = "clay"
points_per_cell = 4
[material.clay]
law = "drucker-prager"
E = 1e4
nu = 0.3
rho = 2.0
phi = 20
psi = 20
c = 10
[phase]
max_motion = "none"
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
[[traction]]
face = "top"
value = [0, -28]
[stop]
residual = 1e-8
steps = 20000
[[probe]]
name = "middle"
at = [1.0, 0.5]
fields = ["u.y", "stress.yy", "stress.xx"]
)";

TEST_CASE("a static iteration is one implicit increment of the law, committed at its end", "[strategies]") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("block.toml", yielding_block);
  Values u_y;
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

TEST_CASE("what a strategy has found goes on from phase to phase, even where each step is one", "[strategies]") {
  // fire needs a direction that lasts: it takes phases of a few steps.
  const test::TemporaryFolder folder;
  const auto file = folder.write("column.toml", R"(dim = 2
[grid]
min = [0, 0]
max = [2, 10]
cells = [1, 8]
basis = "quadratic"
[body]
material = "soil"
points_per_cell = 4
[material.soil]
law = "hencky"
E = 5e6
nu = 0.3
rho = 1600
[phase]
max_motion = 0
[[support]]
face = "bottom"
[[support]]
face = "left"
kind = "roller"
[[support]]
face = "right"
kind = "roller"
[body_force]
value = [0, -9.81]
[stop]
residual = 1e-6
steps = 3000
)");
  for (const std::string strategy : {"adaptive", "papadrakakis", "auto", "fire2"}) {
    const std::string max_motion = strategy == "fire2" ? "0.0005" : "0";
    const Summary summary = run(load_scene(file, {test::override_of(strategy), "phase.max_motion=" + max_motion}));
    CAPTURE(strategy, summary.reason, summary.phases);
    CHECK(summary.status == RunStatus::equilibrium);
    CHECK(summary.phases > 100);
  }
}

TEST_CASE("every dynamic strategy relaxes a block that yields", "[strategies]") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("block.toml", yielding_block);
  for (const std::string& strategy : iterations) {
    if (catalogue().static_method(strategy)) continue;
    const Summary summary = run(load_scene(file, {test::override_of(strategy)}));
    CAPTURE(strategy, summary.reason, summary.rhs_evaluations);
    CHECK(summary.status == RunStatus::equilibrium);
    CHECK(scenes::probe(summary, "middle", "stress.yy") == Approx(-28).epsilon(0.2));
  }
}

TEST_CASE("auto scales the mass where that makes the condition number smaller, and says so", "[strategies]") {
  const auto note_of = [](const std::vector<std::string>& more) {
    std::vector<std::string> set = {"damping.strategy=auto"};
    set.insert(set.end(), more.begin(), more.end());
    const Model model = make_model(scenes::load("neo_hookean_bar", set));
    for (const std::string& note : model.notes) {
      if (note.starts_with("auto")) return note;
    }
    return std::string();
  };
  CHECK_THAT(note_of({}), Catch::Contains("Gershgorin"));
  CHECK(note_of({"mass.scaling=1", "mass.kind=lumped"}).empty());
  CHECK(note_of({"mass.kind=consistent"}).empty());
  CHECK_THAT(note_of({"stop.residual=0", "stop.time=1"}), Catch::Contains("physical mass"));
}

TEST_CASE("the motion of auto recovers from a step past the critical one", "[strategies]") {
  test::Chain chain({.n = 40, .left_held = true, .right_held = true, .load = 1e-3});
  const Values solution = static_solution(chain);
  const double omega_max = chain.exact_omega(40);
  CHECK(evaluations_to(1e-6, chain, solution, omega_max,
                       {.strategy = "auto", .step_fraction = 1.2, .options = {.single_phase = false}}, 2000) < 1000);
}

/// A chain whose forces are never better than to an amplitude: equilibrium cannot be approached further.
class NoisyChain final : public test::Chain {
 public:
  using Chain::Chain;
  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
    const bool ok = Chain::internal_force(t, u, R, trial);
    for (double& r : R) r += 1e-3 * (2 * static_cast<double>(random_()) / 4294967295.0 - 1);
    return ok;
  }

 private:
  mutable std::mt19937 random_{3};
};

TEST_CASE("a motion of auto that makes no way any more gives up its c, and takes it up again where that does not help",
          "[strategies]") {
  NoisyChain chain({.n = 40, .left_held = true, .right_held = true, .load = 1});
  const auto damping = test::damping_of("auto", 0, 0);
  RelaxationSystem system(chain, *damping);
  IntegratorOptions options;
  options.max_step = 0.95 * 2 / chain.exact_omega(40);
  const auto integrator = test::stepper_of("auto", options, system, {.single_phase = false});
  Values y(2 * chain.size());
  Vector state = system.vectors().view(y);
  integrator->start(0, state);
  std::vector<int> changes;
  bool damped = true;
  int without = 0;
  for (int k = 0; k < 6000; ++k) {
    REQUIRE(integrator->step(1e9).status == StepReport::Status::ok);
    without = *integrator->damping_rate() == 0 ? without + 1 : 0;
    const bool now = without < 50;  // a quotient may be negative for a step
    if (now != damped) changes.push_back(k);
    damped = now;
  }
  CHECK(changes.size() >= 2);
  double error = 0, scale = 0;
  const Values solution = static_solution(test::Chain(chain.options()));
  for (std::size_t i = 0; i < solution.size(); ++i) {
    error += std::pow(y[i] - solution[i], 2);
    scale += std::pow(solution[i], 2);
  }
  CHECK(error < 1e-2 * 1e-2 * scale);
}

TEST_CASE("auto without a steady pull halts nothing: its motion is that of adaptive damping", "[strategies]") {
  const auto motion = [](const std::string& strategy, bool steady) {
    test::Chain chain({.n = 10, .cubic = 5});
    const auto damping = test::damping_of(strategy, 0, 0);
    RelaxationSystem system(chain, *damping);
    IntegratorOptions options;
    options.max_step = 0.1;
    const auto integrator = test::stepper_of(strategy, options, system, {.steady = steady});
    Values y(2 * chain.size());
    for (std::size_t i = 0; i < chain.size(); ++i) y[chain.size() + i] = 1;  // uphill
    Vector state = system.vectors().view(y);
    integrator->start(0, state);
    for (int k = 0; k < 200; ++k) REQUIRE(integrator->step(1e6).status == StepReport::Status::ok);
    return y;
  };
  CHECK(motion("auto", false) == motion("adaptive", true));
  CHECK(motion("auto", true) != motion("adaptive", true));
}

TEST_CASE("strategies relax a block that leans on a wall, whose nodes open and close", "[strategies]") {
  for (const std::string& strategy : iterations) {
    if (catalogue().static_method(strategy) || find_relaxation(strategy)->needs_omega_1) continue;
    const Summary summary = run(scenes::load(
        "block_on_wall", {test::override_of(strategy), "stop.residual=1e-6", "stop.time=0", "stop.steps=100000"}));
    CAPTURE(strategy, summary.reason, summary.rhs_evaluations);
    CHECK(summary.status == RunStatus::equilibrium);
  }
}

TEST_CASE("options that a relaxation or a damping does not go with are refused with a reason", "[strategies]") {
  test::Chain chain({.n = 3});
  const auto combined = make_damping("combined", 0, 0.5), none = no_damping();
  RelaxationSystem damped(chain, *combined), undamped(chain, *none);
  CHECK_THROWS_WITH(make_integrator({.method = "erk:rk4", .max_step = 0.1}, damped),
                    Catch::Contains("symplectic-euler"));
  CHECK_THROWS_WITH(make_relaxation({.name = "chebyshev", .max_step = 0.1}, undamped), Catch::Contains("omega_1"));
  CHECK_THROWS_WITH(make_relaxation({.name = "fire", .max_step = 0}, undamped), Catch::Contains("max_step"));
  CHECK_THROWS_WITH(make_relaxation({.name = "newton", .max_step = 0.1}, undamped), Catch::Contains("no relaxation"));
}

}  // namespace
