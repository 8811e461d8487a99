// y = [u; p] with the momentum p = M v, of a mass that is known by its inverse: the motion is that of y = [u; v].
#include <stillpoint/relaxation.hpp>
#include <stillpoint/state_norms.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "largest.hpp"
#include "missing_method.hpp"
#include "way_to_rest.hpp"

using namespace stillpoint;
using stillpoint::test::Chain;
using stillpoint::test::damping_of;
using stillpoint::test::is_missing;
using stillpoint::test::stepper_of;

namespace {

struct NamedWay {
  const char *strategy, *method;
};

Chain uneven_chain(bool consistent) {
  return Chain(
      {.masses = {1, 0.5, 2, 4, 0.25, 1, 3, 1, 0.7, 2}, .right_held = true, .consistent = consistent, .load = 0.1});
}

// After so many steps from rest: u, and v or p.
std::vector<double> state_after(const NamedWay& way, Chain& chain, const Mass* fictitious, double h, double omega_1,
                                int steps) {
  const auto damping = damping_of(way.strategy, 2 * omega_1, 0.1);
  const VectorSpace vectors;
  RelaxationSystem system(chain, *damping, vectors, fictitious);
  Vector y = vectors.make(2 * chain.size());
  const auto integrator = stepper_of(way.strategy, {.method = way.method, .max_step = h}, system,
                                     {.omega_1 = omega_1, .steady = true, .linear = true});
  integrator->start(0, y);
  for (int k = 0; k < steps; ++k) {
    const StepReport report = integrator->step(1e6);
    CAPTURE(report.message);
    REQUIRE(report.status == StepReport::Status::ok);
  }
  return {y.span().begin(), y.span().end()};
}

}  // namespace

TEST_CASE("a mass that is known by its inverse alone moves a body as the same mass with its product does") {
  const auto way =
      GENERATE(NamedWay{"viscous", "leapfrog"}, NamedWay{"viscous", "symplectic-euler"}, NamedWay{"viscous", "erk:rk4"},
               NamedWay{"viscous", "erk:heun-euler-2-1-2"}, NamedWay{"viscous", "gsl:rk4"},
               NamedWay{"kinetic", "leapfrog"}, NamedWay{"kinetic", "erk:rk4"}, NamedWay{"adaptive", "leapfrog"},
               NamedWay{"papadrakakis", "leapfrog"}, NamedWay{"chebyshev", "leapfrog"}, NamedWay{"auto", "leapfrog"});
  if (is_missing(way.method)) return;
  const bool consistent = GENERATE(false, true);
  CAPTURE(way.strategy, way.method, consistent);
  Chain chain = uneven_chain(consistent);
  const Mass& M = chain.mass();
  const Mass inverse = Mass::by_inverse(M.size(), [&M](ConstVec b, Vec x) { M.solve(b, x); });
  constexpr double h = 0.2, omega_1 = 0.2;  // below 2/ω_max of both masses; about ω₁
  constexpr int steps = 6;                  // few: what differs by rounding may later turn at another step
  const std::vector<double> known = state_after(way, chain, nullptr, h, omega_1, steps);
  const std::vector<double> by_inverse = state_after(way, chain, &inverse, h, omega_1, steps);
  const ConstVec u = first_half(ConstVec(known)), v = second_half(ConstVec(known));
  CHECK(largest_magnitude(u) > 0.001);
  CHECK(largest_difference(first_half(ConstVec(by_inverse)), u) < 1e-12 * largest_magnitude(u));
  std::vector<double> p(v.size());
  M.apply(v, p);
  CHECK(largest_difference(second_half(ConstVec(by_inverse)), p) <= 1e-12 * largest_magnitude(p));
}

TEST_CASE("a step takes M⁻¹ once and knows its velocity and acceleration: energy and error bound take no further M⁻¹") {
  const auto [strategy, method] = GENERATE(NamedWay{"auto", "leapfrog"}, NamedWay{"kinetic", "leapfrog"},
                                           NamedWay{"papadrakakis", "leapfrog"}, NamedWay{"chebyshev", "leapfrog"},
                                           NamedWay{"viscous", "leapfrog"}, NamedWay{"viscous", "symplectic-euler"});
  CAPTURE(strategy, method);
  Chain chain = uneven_chain(false);
  const Mass& M = chain.mass();
  int inverses = 0;
  const Mass inverse = Mass::by_inverse(M.size(), [&](ConstVec b, Vec x) { ++inverses, M.solve(b, x); });
  constexpr double h = 0.2, omega_1 = 0.2;
  const auto damping = damping_of(strategy, 2 * omega_1, 0.1);
  const VectorSpace vectors;
  RelaxationSystem system(chain, *damping, vectors, &inverse);
  StateNorms norms(system);
  Vector y = vectors.make(2 * chain.size());
  const auto iteration = stepper_of(strategy, {.method = method, .max_step = h}, system,
                                    {.omega_1 = omega_1, .steady = true, .linear = true});
  iteration->start(0, y);
  for (int k = 1; k <= 6; ++k) {
    inverses = 0;
    const StepReport report = iteration->step(1e6);
    REQUIRE(report.status == StepReport::Status::ok);
    const Vector p = vectors.view(second_half(y.span()));
    const double residual = norms.last_residual();
    const double energy = norms.motion(p, iteration->known().velocity).kinetic_energy;
    const double error = norms.energy_error(inverse, omega_1, iteration->known().acceleration);
    CHECK(inverses == 1);  // of the step
    CHECK(residual > 0);
    CHECK_THAT(energy, Catch::WithinRel(norms.motion(p).kinetic_energy, 1e-10) || Catch::WithinAbs(0, 1e-30));
    CHECK_THAT(error, Catch::WithinRel(norms.energy_error(inverse, omega_1), 1e-12));
  }
}
