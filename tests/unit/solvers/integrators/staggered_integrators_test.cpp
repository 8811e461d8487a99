// Leapfrog and symplectic Euler against the difference equations that define them, from the displacements alone:
//   M (v⁺ − v⁻)/h + C w = Q(u_n),   v⁺ = (u_{n+1} − u_n)/h,   v⁻ = (u_n − u_{n−1})/h.
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "largest.hpp"

namespace {

using namespace stillpoint;
using Values = std::vector<double>;

constexpr double h = 0.2;
const Values masses = {1, 2, 0.5, 1.5};

/// u_0, u_1, u_2, … of a chain with a cubic spring; damping of strength 0.6 [1/s or kg/s], α = 0.6.
std::vector<Values> displacements(test::Chain& chain, const std::string& strategy, const std::string& method,
                                  DampingTreatment treatment) {
  const auto damping = make_damping(strategy, 0.6, 0.6);
  RelaxationSystem system(chain, *damping);
  IntegratorOptions options;
  options.method = method;
  options.treatment = treatment;
  options.max_step = h;
  const auto integrator = make_integrator(options, system);
  Values y = {0.3, -0.1, 0.2, 0.4, 1, -1, 0.5, 0.1};
  Vector vector = system.vectors().view(y);
  integrator->start(0, vector);
  std::vector<Values> u = {{y.begin(), y.begin() + 4}};
  for (int step = 1; step <= 6; ++step) {
    REQUIRE(integrator->step(step * h).status == StepReport::Status::ok);
    u.push_back({y.begin(), y.begin() + 4});
  }
  return u;
}

/// The largest |M (v⁺ − v⁻)/h + C w − Q − D(v⁻, Q)| with w = (1 − θ) v⁻ + θ v⁺.
double defect(const test::Chain& chain, const std::string& strategy, const std::vector<Values>& u, double theta) {
  const auto damping = make_damping(strategy, 0.6, 0.6);
  const LinearDamping C = damping->linear();
  const std::size_t n = chain.size();
  Largest largest;
  for (std::size_t step = 1; step + 1 < u.size(); ++step) {
    Values v_before(n), change(n), w(n), inertia(n), Mw(n), Q(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double v_after = (u[step + 1][i] - u[step][i]) / h;
      v_before[i] = (u[step][i] - u[step - 1][i]) / h;
      change[i] = (v_after - v_before[i]) / h;
      w[i] = (1 - theta) * v_before[i] + theta * v_after;
    }
    chain.mass().apply(change, inertia);
    chain.mass().apply(w, Mw);
    chain.internal_force(0, u[step], Q, *chain.make_trial());
    for (double& q : Q) q = chain.options().load - q;
    damping->add_local(v_before, Q);
    for (std::size_t i = 0; i < n; ++i) {
      largest.take_magnitude(inertia[i] + C.mass * Mw[i] + C.identity * w[i] - Q[i]);
    }
  }
  return largest.value();
}

struct Scheme {
  std::string method;
  DampingTreatment treatment;
  double theta;
};

TEST_CASE("displacements satisfy the scheme's difference equation for every mass and damping", "[integrator]") {
  for (const Scheme& scheme : {Scheme{"leapfrog", DampingTreatment::automatic, 0.5},
                               {"leapfrog", DampingTreatment::averaged, 0.5},
                               {"leapfrog", DampingTreatment::lagged, 0},
                               {"symplectic-euler", DampingTreatment::automatic, 1},
                               {"symplectic-euler", DampingTreatment::implicit, 1},
                               {"symplectic-euler", DampingTreatment::lagged, 0}}) {
    for (const bool consistent : {false, true}) {
      for (const std::string strategy : {"none", "viscous", "identity", "one-sided", "cundall"}) {
        test::Chain chain({.cubic = 0.5, .masses = masses, .consistent = consistent, .load = 0.2});
        const auto u = displacements(chain, strategy, scheme.method, scheme.treatment);
        CAPTURE(scheme.method, scheme.theta, consistent, strategy);
        CHECK(defect(chain, strategy, u, scheme.theta) < 1e-13);
        const bool damped = strategy == "viscous" || strategy == "identity";
        CHECK((defect(chain, strategy, u, 1 - scheme.theta + 0.25) > 1e-3) == damped);  // the test can tell
      }
    }
  }
}

TEST_CASE("exact damping decays a free velocity by e^{-ct} and agrees with implicit damping for small steps",
          "[integrator]") {
  // No spring: u'' = −(c/m) u'
  for (const std::string strategy : {"viscous", "identity"}) {
    test::Chain chain({.masses = {2}, .left_held = false});
    const auto damping = make_damping(strategy, 0.6, 0);
    const double rate = strategy == "viscous" ? 0.6 : 0.3;
    RelaxationSystem system(chain, *damping);
    IntegratorOptions options;
    options.method = "symplectic-euler";
    options.treatment = DampingTreatment::exact;
    options.max_step = 0.5;
    const auto integrator = make_integrator(options, system);
    Values y = {0, 1};
    Vector vector = system.vectors().view(y);
    integrator->start(0, vector);
    for (int step = 1; step <= 4; ++step) integrator->step(0.5 * step);
    CHECK(y[1] == Approx(std::exp(-rate * 2)).epsilon(1e-14));
  }
}

TEST_CASE("leapfrog with identity damping may change its step between calls", "[integrator]") {
  // The factor of M + h/2 C is kept by h: alternating steps must give what fresh integrators give.
  test::Chain chain({.masses = masses, .consistent = true});
  const auto damping = make_damping("identity", 0.6, 0);
  RelaxationSystem system(chain, *damping);
  IntegratorOptions options;
  options.max_step = 0.2;
  const auto kept = make_integrator(options, system);
  Values y = {0.3, -0.1, 0.2, 0.4, 1, -1, 0.5, 0.1};
  Vector vector = system.vectors().view(y);
  kept->start(0, vector);
  double t = 0;
  for (const double step : {0.2, 0.1, 0.2, 0.05}) {
    Values fresh_y = y;
    Vector fresh_vector = system.vectors().view(fresh_y);
    const auto fresh = make_integrator(options, system);
    fresh->start(t, fresh_vector);
    fresh->step(t + step);
    kept->step(t + step);
    t += step;
    for (std::size_t i = 0; i < y.size(); ++i) CHECK(y[i] == Approx(fresh_y[i]).epsilon(1e-13));
  }
}

}  // namespace

TEST_CASE("a mode of a long chain stays one, at every degree of freedom, under each method and treatment") {
  const auto [method, treatment] =
      GENERATE(table<std::string, DampingTreatment>({{"leapfrog", DampingTreatment::averaged},
                                                     {"leapfrog", DampingTreatment::lagged},
                                                     {"symplectic-euler", DampingTreatment::implicit},
                                                     {"symplectic-euler", DampingTreatment::exact}}));
  const auto* strategy = GENERATE("none", "viscous", "identity");
  CAPTURE(method, strategy);
  constexpr std::size_t n = 20'001;
  constexpr double waves = 3001;
  test::Chain chain({.n = n, .right_held = true});
  const auto damping = make_damping(strategy, 0.3, 0);
  RelaxationSystem system(chain, *damping);
  IntegratorOptions options;
  options.method = method;
  options.max_step = h;
  options.treatment = treatment;
  Vector y = system.vectors().make(2 * n);
  const Vec u = first_half(y.span()), v = second_half(y.span());
  Values mode(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = std::numbers::pi * waves * static_cast<double>(i + 1) / static_cast<double>(n + 1);
    mode[i] = u[i] = std::sin(angle);
  }
  const auto integrator = make_integrator(options, system);
  integrator->start(0, y);
  for (int k = 0; k < 5; ++k) REQUIRE(integrator->step(1e9).status == StepReport::Status::ok);
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(mode) - mode.begin());
  const double u_share = u[largest] / mode[largest], v_share = v[largest] / mode[largest];
  CHECK(std::abs(v_share) > 0.01);
  Largest worst;
  for (std::size_t i = 0; i < n; ++i) {
    worst.take_magnitude(u[i] - u_share * mode[i]);
    worst.take_magnitude(v[i] - v_share * mode[i]);
  }
  CHECK(worst.value() < 1e-9);  // rounding of the angle, 1e4 times π
}
