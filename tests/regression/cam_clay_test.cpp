// Samples of Modified Cam clay in motion, by Newton's method and in phases, beside an independent integration of the
// rate equations: problems/ladder/triaxial_clay.toml.
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "driven.hpp"
#include "scenes.hpp"
#include "solvers/relaxation/relaxations.hpp"

using namespace stillpoint;
using scenes::with;

namespace {

using Set = std::vector<std::string>;

Summary triaxial(const Set& set) { return run(scenes::load("ladder/triaxial_clay", set), {.threads = 1}); }

struct Clay {
  double p, q, pc, e;  // pressures positive [kPa]
};
Clay middle(const Summary& s) {
  const auto at = [&](const char* field) { return scenes::probe(s, "middle", field); };
  return {-(at("stress.xx") + at("stress.yy") + at("stress.zz")) / 3e3, (at("stress.xx") - at("stress.yy")) / 1e3,
          at("pc") / 1e3, at("void_ratio")};
}
void check(const Clay& at, const Clay& expected, double tolerance) {
  CHECK(at.p == Approx(expected.p).epsilon(tolerance));
  CHECK(at.q == Approx(expected.q).epsilon(tolerance));
  CHECK(at.pc == Approx(expected.pc).epsilon(tolerance));
  CHECK(at.e == Approx(expected.e).epsilon(tolerance));
}

// At an axial strain of 20 %, from OCR = 1 and 5
const Clay wet_sample{154.07028620869085, 162.2108586260725, 272.66858648094785, 0.8222165469008322};
const Clay dry_sample{172.74753715843437, 218.2426114753031, 364.2193031843979, 1.0288298681534775};

}  // namespace

TEST_CASE(
    "a triaxial sample of Cam clay that is slowly compressed hardens on the wet side and softens on the dry one") {
  check(middle(triaxial({})), wet_sample, 1e-3);
  check(middle(triaxial({"material.clay.OCR=5"})), dry_sample, 1e-3);
}

TEST_CASE("Newton's method loads a sample of Cam clay to the state of its motion") {
  // The platen is free and bears cell + q. The load factor leads from the first internal forces, which are held on the
  // first area: the cell pressure is not quite constant on the way, which the strain shows and the state does not.
  const auto loaded = [](const char* steps) {
    return triaxial({"support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                     "traction=[{face='right', pressure='cell'}, {face='top', pressure='cell + 162210.8586260725'}]",
                     "solve.method=newton", "damping={}", "mass={}", "output={}", "stop.residual=1e-8", "stop.time=0",
                     std::string("solve.load_steps=") + steps,
                     "probe=[{name='middle', at=[0.025, 0.05], fields=['stress.xx', 'stress.yy', 'stress.zz', 'pc', "
                     "'void_ratio']}, {name='corner', at=[0.05, 0.1], fields=['u.y']}]"});
  };
  for (const char* steps : {"20", "100"}) {
    const Summary s = loaded(steps);
    CHECK(s.status == RunStatus::equilibrium);
    check(middle(s), wet_sample, 1e-6);
    CHECK(scenes::probe(s, "corner", "u.y") == Approx(0.1 * std::expm1(-0.2)).epsilon(0.04));
  }
}

TEST_CASE("clay whose first trial cannot be evaluated ends a static solution with its reason") {
  // A platen that goes so far that the upper cells would be crushed in the smallest share of its way
  const Summary s =
      triaxial({"solve.method=newton", "damping={}", "mass={}", "output={}", "stop={time=2}", "support[2].u=-50*H*t"});
  CHECK(s.status == RunStatus::failed);
  CHECK_THAT(s.reason, Catch::Contains("cannot be evaluated"));
}

TEST_CASE("a motion in phases leads a sample of Cam clay near to the state of a single one") {
  // A load instead of the platen, as the grid does not follow it. A border that moves through the cells costs some
  // per cent of the stress, with any law: a sample of Mohr–Coulomb soil that strains as much loses 3 and 9 %.
  const Summary s = triaxial({"support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                              "traction=[{face='right', pressure='cell'}, {face='top', pressure='cell + "
                              "100e3*min(t/T, 1)'}]",
                              "phase.max_motion=0.1"});
  CHECK(s.phases > 2);
  CHECK(middle(s).p == Approx(100 + 100.0 / 3).epsilon(0.07));
  CHECK(middle(s).q == Approx(100).epsilon(0.07));
}

TEST_CASE("a sample of Cam clay pressed until it is six times as stiff comes to rest under every relaxation") {
  // From 100 to 800 kPa on all sides: v = 2 − λ ln 8, and K = v p/κ
  const double v = 2 - 0.2 * std::log(8);
  const auto relaxed = [](const std::string& strategy, const Set& more) {
    Scene scene = scenes::load("ladder/triaxial_clay",
                               with({"support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                                     "traction=[{face='right', pressure='cell*(1 + 7*min(t/0.1, 1))'}, {face='top', "
                                     "pressure='cell*(1 + 7*min(t/0.1, 1))'}]",
                                     "stop.residual=1e-6", "stop.time=0"},
                                    more));
    scene.damping = {};
    scene.damping.strategy = strategy;
    return run(scene, {.threads = 1});
  };
  std::vector<std::string> strategies = {"viscous", "cundall"};
  for (const RelaxationInfo& relaxation : relaxations()) strategies.emplace_back(relaxation.about.name);
  for (const std::string& strategy : strategies) {
    CAPTURE(strategy);
    const Summary s = relaxed(strategy, {});
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(middle(s).p == Approx(800).epsilon(2e-3));
    // A swing beyond 800 kPa leaves it denser
    CHECK(middle(s).e == Approx(v - 1).epsilon(5e-3));
    CHECK(middle(s).pc == Approx(800).epsilon(1e-2));
  }
  // The step of the first stiffness, 0.9 of the critical one, is too long for the last one
  const double first = relaxed("viscous", {"stop.steps=1"}).dt;
  CHECK(relaxed("viscous", {"integrator.step=" + std::to_string(first), "stop.steps=20000"}).status !=
        RunStatus::equilibrium);
}
