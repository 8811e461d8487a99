// Evaluations of a phase are const in truth. `scripts/test tsan` runs this program under the thread sanitizer.
#include <stillpoint/stillpoint.hpp>

#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "random_values.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;

namespace {

// Everything that a solver asks of a phase in one state.
struct Answer {
  bool good = false;
  std::vector<double> F, R, K_du, reactions{}, stress{};
  SparseMatrix K{};
};

Answer evaluate(const LagrangianPhase& phase, double t, const std::vector<double>& u) {
  const std::size_t n = phase.size();
  Answer of{.F = std::vector<double>(n), .R = std::vector<double>(n), .K_du = std::vector<double>(n)};
  const auto trial = phase.make_trial();
  phase.external_force(t, u, of.F);
  of.good = phase.internal_force(t, u, of.R, *trial);
  of.reactions = trial->reactions;
  phase.tangents().apply(Tangent::consistent, t, u, u, of.K_du);
  of.K = phase.tangents().matrix(Tangent::consistent, t, u);
  of.stress.resize(static_cast<std::size_t>(phase.info().stress_components) * phase.points());
  phase.fields().point_stress(t, u, of.stress);
  return of;
}

bool same_bits(const Answer& a, const Answer& b) {
  return a.good == b.good && a.F == b.F && a.R == b.R && a.K_du == b.K_du && a.reactions == b.reactions &&
         a.stress == b.stress && SparseMatrix(a.K - b.K).norm() == 0;
}

}  // namespace

TEST_CASE("two threads evaluate two states of one phase with the bits of a single thread") {
  const std::vector<std::string> coarse{"grid.cells=[8,8]"};
  const std::vector<Scene> all{
      scenes::load("footing", coarse),  // yields; cells share their dilatation
      scenes::load("footing", {"grid.cells=[8,8]", "grid.basis=quadratic", "phase.dilatation=splines"}),
      scenes::load("cylinder", {"grid.cells=[8,8]", "material.steel.law=neo-hookean", "phase.dilatation=splines",
                                "grid.basis=quadratic"}),  // a pressure that follows
      scenes::load("inclusion", coarse)};                  // elastic cells
  for (const Scene& scene : all) {
    const auto phase = make_phase(scene);
    INFO(scene.title << ", dilatation " << static_cast<int>(phase->info().nonlinear));
    const std::vector<double> times{0.3, 0.7};
    std::vector<std::vector<double>> u;
    std::vector<Answer> alone;
    for (unsigned k = 0; k < 2; ++k) {
      u.push_back(test::random_values(phase->size(), 1e-4, k));
      alone.push_back(evaluate(*phase, times[k], u[k]));
      REQUIRE(alone[k].good);
    }
    CHECK_FALSE(same_bits(alone[0], alone[1]));
    constexpr int rounds = 10;
    std::vector<int> as_alone(2, 0);
    std::vector<std::thread> threads;
    for (unsigned k = 0; k < 2; ++k) {
      threads.emplace_back([&, k] {
        for (int round = 0; round < rounds; ++round)
          as_alone[k] += same_bits(evaluate(*phase, times[k], u[k]), alone[k]) ? 1 : 0;
      });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(as_alone == std::vector<int>(2, rounds));
  }
}

TEST_CASE("a state that cannot be evaluated leaves nothing behind for the next one") {
  for (const std::string dilatation : {"points", "cells", "splines"}) {
    INFO("dilatation = " << dilatation);
    const auto phase = make_phase(scenes::load("cylinder", {"grid.cells=[8,8]", "material.steel.law=neo-hookean",
                                                            "grid.basis=quadratic", "phase.dilatation=" + dilatation}));
    const auto u = test::random_values(phase->size(), 1e-4, 1);
    const Answer before = evaluate(*phase, 0, u);
    REQUIRE(before.good);
    std::vector<double> R(phase->size());
    const std::vector<double> nowhere(phase->size(), std::numeric_limits<double>::quiet_NaN());
    CHECK_FALSE(phase->internal_force(0, nowhere, R, *phase->make_trial()));
    CHECK(same_bits(evaluate(*phase, 0, u), before));
  }
}
