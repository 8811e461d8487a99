// The conjugate directions by which auto goes while its system is linear enough.
#include <stillpoint/state_norms.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "solvers/relaxation/relaxing.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("auto takes the steps of conjugate gradients for one evaluation each, whatever step it is given first",
          "[strategies]") {
  const Chain chain(long_chain());
  for (const double share : {0.1, 0.9, 3.0}) {
    const Way way = {.strategy = "auto", .step_fraction = share, .options = {.linear = true}};
    CAPTURE(share);
    CHECK(evaluations_of(chain, way, 1e-9) == Approx(79).margin(2));  // 78 modes, and the one at rest
  }
}

TEST_CASE("the out-of-balance force that auto has found on its way is that of its iterate, down to rounding",
          "[strategies]") {
  for (const double cubic : {0.0, 1e3}) {  // linear, and stiffening
    ChainOptions chain_options = long_chain();
    chain_options.cubic = cubic;
    Chain chain(chain_options), again(chain_options);
    Relaxing relaxing(chain, {.strategy = "auto", .options = {.linear = cubic == 0}}, 0.9);
    RelaxationSystem fresh(again, *relaxing.damping);
    Vector Q = fresh.vectors().make(again.size());
    const double load = chain_options.load * std::sqrt(static_cast<double>(chain_options.n));
    double least = load;
    for (int k = 0; k < 5000 && !relaxing.stepper->moves() && least > 1e-12 * load; ++k) {
      const StepReport step = relaxing.step();
      REQUIRE(fresh.out_of_balance(step.t, first_half(ConstVec(relaxing.y)), Q.span()));
      const auto known = relaxing.stepper->known().unbalanced_force;
      if (!known) break;
      CAPTURE(cubic, k);
      CHECK(*known == Approx(norm(Q)).epsilon(1e-9).margin(1e-13 * load));
      CHECK(*known / relaxing.system.force_scale() ==
            Approx(StateNorms(fresh).last_residual()).epsilon(1e-9).margin(1e-13));
      least = norm(Q);
    }
    CHECK(least < 1e-9 * load);  // it came that far by such steps
  }
}

TEST_CASE("auto ends after as many steps as a short chain has modes, though its residual falls by all digits at once",
          "[strategies]") {
  for (std::size_t n = 1; n <= 12; ++n) {
    const Chain chain({.n = n, .stiffness = 3, .load = 1e-3});
    Chain system(chain.options());
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

TEST_CASE("a force that is not finite ends a step of auto, though the system has let it pass", "[strategies]") {
  class Breaking final : public Chain {
   public:
    using Chain::Chain;
    bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
      Chain::internal_force(t, u, R, trial);
      if (u[0] != 0) R[1] = std::numeric_limits<double>::infinity();
      return true;
    }
  };
  Breaking chain({.n = 3, .load = 1});
  Relaxing relaxing(chain, {.strategy = "auto", .options = {.linear = true}}, 0.9);
  CHECK(relaxing.stepper->step(1e9).status == StepReport::Status::not_finite);
  CHECK(relaxing.y == Values(6, 0.0));  // the last good state
}

TEST_CASE("auto stays where nothing but rounding is left", "[strategies]") {
  for (const bool linear : {true, false}) {
    Chain chain(long_chain());
    const Values solution = static_solution(chain);
    Relaxing relaxing(chain, {.strategy = "auto", .options = {.linear = linear}},
                      0.9 * 2 / chain.exact_omega(chain.size()));
    for (int k = 0; k < 5000; ++k) {
      relaxing.step();
      if (k < (linear ? 90 : 500)) continue;  // 78 modes, and some steps for rounding
      CAPTURE(linear, k);
      REQUIRE(largest_difference(first_half(ConstVec(relaxing.y)), solution) <= 1e-9 * solution[chain.size() / 2]);
    }
  }
}
