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

namespace {

using Set = std::vector<std::string>;

Set with(Set set, const Set& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}
Summary triaxial(const Set& set) { return run(scenes::load("ladder/triaxial_clay", set), {.threads = 1}); }

struct State {
  double p, q, pc, e;  // pressures positive [kPa]
};
State middle(const Summary& s) {
  const auto at = [&](const char* field) { return scenes::probe(s, "middle", field); };
  return {-(at("stress.xx") + at("stress.yy") + at("stress.zz")) / 3e3, (at("stress.xx") - at("stress.yy")) / 1e3,
          at("pc") / 1e3, at("void_ratio")};
}
void check(const State& at, const State& expected, double tolerance) {
  CHECK(at.p == Approx(expected.p).epsilon(tolerance));
  CHECK(at.q == Approx(expected.q).epsilon(tolerance));
  CHECK(at.pc == Approx(expected.pc).epsilon(tolerance));
  CHECK(at.e == Approx(expected.e).epsilon(tolerance));
}

// At an axial strain of 20 %, from OCR = 1 and 5
const State wet{154.07028620869085, 162.2108586260725, 272.66858648094785, 0.8222165469008322};
const State dry{172.74753715843437, 218.2426114753031, 364.2193031843979, 1.0288298681534775};

}  // namespace

TEST_CASE(
    "a triaxial sample of Cam clay that is slowly compressed hardens on the wet side and softens on the dry one") {
  check(middle(triaxial({})), wet, 1e-3);
  check(middle(triaxial({"material.clay.OCR=5"})), dry, 1e-3);
}

TEST_CASE("Newton's method and a motion in phases lead a sample of Cam clay to the same state") {
  // Forty steps of half a per cent, along each of which the strain is straight: second order
  const Set newton = {"solve.method=newton", "damping={}", "mass={}", "output={}", "stop={time=2}"};
  check(middle(triaxial(with(newton, {"solve.load_steps=40"}))), wet, 5e-3);
  check(middle(triaxial(with(newton, {"solve.load_steps=160"}))), wet, 1e-3);
  // Points that move from cell to cell lose the evenness of the sample a little
  const Summary phases = triaxial({"phase.max_motion=0.1"});
  CHECK(phases.phases > 3);
  check(middle(phases), wet, 0.02);
}

TEST_CASE("a sample of Cam clay pressed until it is six times as stiff comes to rest under every relaxation") {
  // From 100 to 800 kPa on all sides: v = 2 − λ ln 8, and K = v p/κ
  const double v = 2 - 0.2 * std::log(8), stretch = std::cbrt(v / 2);
  const Set pressed = {"support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                       "traction=[{face='right', pressure='cell*(1 + 7*min(t/0.05, 1))'}, {face='top', "
                       "pressure='cell*(1 + 7*min(t/0.05, 1))'}]",
                       "stop={residual=1e-6}", "output={}",
                       "probe=[{name='middle', at=[0.025, 0.05], fields=['stress.xx', 'stress.yy', 'stress.zz', 'pc', "
                       "'void_ratio']}, {name='corner', at=[0.05, 0.1], fields=['u.x', 'u.y']}]"};
  std::vector<std::string> strategies = {"viscous", "local"};
  for (const RelaxationInfo& relaxation : relaxations()) strategies.emplace_back(relaxation.about.name);
  for (const std::string& strategy : strategies) {
    CAPTURE(strategy);
    const Summary s = triaxial(with(pressed, {"damping={strategy='" + strategy + "'}"}));
    CHECK(s.status == RunStatus::equilibrium);
    CHECK(middle(s).p == Approx(800).epsilon(1e-3));
    // A swing beyond 800 kPa would leave it denser
    CHECK(middle(s).e == Approx(v - 1).epsilon(5e-3));
    CHECK(scenes::probe(s, "corner", "u.y") == Approx(0.1 * (stretch - 1)).epsilon(2e-2));
  }
  // The step of the first stiffness is too long for the last one
  const double first = triaxial(with(pressed, {"damping={strategy='viscous'}", "stop.steps=1"})).dt;
  const Summary s = triaxial(with(pressed, {"damping={strategy='viscous'}", "integrator.step=" + std::to_string(first),
                                            "stop.steps=20000", "integrator.unstable_reason='to see it fail'"}));
  CHECK(s.status != RunStatus::equilibrium);
}
