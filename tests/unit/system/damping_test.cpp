#include <stillpoint/damping.hpp>

#include <catch2/catch.hpp>

#include "scenes.hpp"

using namespace stillpoint;

TEST_CASE(
    "one-sided damping takes a share off forces along the motion and leaves those against it [Więckowski 2011, eq. "
    "4]") {
  const auto damping = make_damping("one-sided", 0, 0.2);
  const std::vector<double> v{1, -1, 1, -1, 0};
  std::vector<double> Q{10, 10, -10, -10, 10};
  damping->add_local(v, Q);
  CHECK(Q == std::vector<double>{8, 10, -10, -8, 10});
}

TEST_CASE("Cundall's damping opposes the motion by a share of the force, either way [Cundall 1987]") {
  const auto damping = make_damping("cundall", 0, 0.5);
  const std::vector<double> v{1, -1, 1, -1, 0};
  std::vector<double> Q{10, 10, -10, -10, 10};
  damping->add_local(v, Q);
  CHECK(Q == std::vector<double>{5, 15, -15, -5, 10});
  CHECK(damping->stiffness_factor() == 1.5);
}

TEST_CASE(
    "combined damping acts in full where the force falls and not at all where it grows with the motion "
    "[FLAC, combined damping]",
    "[strategies]") {
  const auto damping = make_damping("combined", 0, 0.8);
  const std::vector<double> v = {1, 1, -1, -1, 0}, last = {20, 5, 20, 5, 10};
  std::vector<double> Q = {10, 10, 10, 10, 10};
  damping->add_local_since(v, last, Q);
  const std::vector<double> expected = {2, 10, 10, 18, 10};
  for (std::size_t i = 0; i < 5; ++i) CHECK(Q[i] == Approx(expected[i]));
  CHECK(damping->stiffness_factor() == Approx(1.8));
}

TEST_CASE("linear strategies say their C: viscous c M, identity c I") {
  CHECK(make_damping("viscous", 0.3, 0)->linear().mass == 0.3);
  CHECK(make_damping("viscous", 0.3, 0)->linear().identity == 0);
  CHECK(make_damping("identity", 0.3, 0)->linear().identity == 0.3);
  CHECK(make_damping("identity", 0.3, 0)->linear().mass == 0);
  CHECK_FALSE(make_damping("identity", 0.3, 0)->is_local());
}

TEST_CASE("parameters out of range and unknown names are refused") {
  CHECK_THROWS_AS(make_damping("viscous", -1, 0), std::invalid_argument);
  CHECK_THROWS_AS(make_damping("cundall", 0, 1), std::invalid_argument);
  CHECK_THROWS_AS(make_damping("rayleigh", 0, 0), std::invalid_argument);
}

TEST_CASE("every strategy that dissipates relaxes to the same static equilibrium") {
  for (const std::string strategy : {"viscous", "identity", "one-sided", "cundall"}) {
    const Summary summary = run(
        scenes::bar({"damping.strategy=" + strategy, "damping.c=critical", "damping.alpha=0.7", "stop.residual=1e-8"}));
    CAPTURE(strategy);
    CHECK(summary.status == RunStatus::equilibrium);
    CHECK(scenes::probe(summary, "p12", "u") == Approx(0.001 * 115.0 / 12).epsilon(1e-6));
    CHECK(scenes::probe(summary, "p12", "stress") == Approx(0.001).epsilon(1e-6));
  }
}
