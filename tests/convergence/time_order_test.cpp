// The observed order in time of every method on offer, with fixed steps.
//
// A chain of four masses on springs with a cubic term under a load that depends on time (so that the nodes c count):
//   u_i'' = T(u_{i+1} − u_i) − T(u_i − u_{i−1}) − c u_i' + ½ cos(3 t + i),   T(e) = e + ½ e³,  0 ≤ t ≤ 4,
// undamped and with c = 0.4. Reference: another library at a tight tolerance.
#include <stillpoint/integrator.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"

namespace {

using namespace stillpoint;

constexpr double end_time = 4;

class DrivenChain : public test::Chain {
 public:
  DrivenChain() : Chain({.n = 4, .cubic = 0.5}) {}
  void external_force(double t, Vec F) const override {
    for (std::size_t i = 0; i < F.size(); ++i) F[i] = 0.5 * std::cos(3 * t + static_cast<double>(i));
  }
};

std::vector<double> state_at_end(const IntegratorOptions& options, double c) {
  DrivenChain chain;
  const auto damping = make_damping("viscous", c, 0);
  RelaxationSystem system(chain, *damping);
  std::vector<double> y(2 * chain.size());
  for (std::size_t i = 0; i < chain.size(); ++i) {
    y[i] = 0.2 * std::sin(0.7 * (static_cast<double>(i) + 1));
    y[chain.size() + i] = 0.3 * std::cos(1.1 * static_cast<double>(i));
  }
  Vector vector = system.vectors().view(y);
  const auto integrator = make_integrator(options, system);
  integrator->start(0, vector);
  StepReport report;
  while (report.t < end_time) {
    report = integrator->step(end_time);
    REQUIRE(report.status == StepReport::Status::ok);
  }
  return y;
}

std::vector<double> reference(const std::string& method, double c) {
  return state_at_end({.method = method, .max_step = 0.1, .rtol = 1e-14, .atol_u = 1e-15, .atol_v = 1e-15}, c);
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squares);
}

// So many steps that the error is in its asymptotic range, and twice as many still above rounding.
int coarse_steps(int order) {
  switch (order) {
    case 1:
      return 1024;
    case 2:
      return 512;
    case 3:
      return 256;
    case 4:
      return 128;
    case 5:
      return 64;
    case 6:
      return 32;
    default:
      return 16;
  }
}

double observed_order(const std::string& method, DampingTreatment treatment, double c, int order) {
  const std::vector<double> exact = reference(method == "gsl:rk8pd" ? "erk:fehlberg-13-7-8" : "gsl:rk8pd", c);
  const auto error = [&](int steps) {
    IntegratorOptions options;
    options.method = method;
    options.treatment = treatment;
    options.max_step = end_time / steps;
    return distance(state_at_end(options, c), exact);
  };
  const int steps = coarse_steps(order);
  return std::log2(error(steps) / error(2 * steps));
}

TEST_CASE("every method shows its order in time, undamped and damped", "[integrator]") {
  for (const Method& method : methods()) {
    if (!method.fixed_step) continue;
    for (const double c : {0.0, 0.4}) {
      CAPTURE(method.name, c);
      CHECK(observed_order(method.name, DampingTreatment::automatic, c, method.order) ==
            Approx(method.order).margin(0.15));
    }
  }
}

TEST_CASE("leapfrog with lagged damping is of second order undamped and of first order damped", "[integrator]") {
  CHECK(observed_order("leapfrog", DampingTreatment::lagged, 0, 2) == Approx(2).margin(0.15));
  CHECK(observed_order("leapfrog", DampingTreatment::lagged, 0.4, 1) == Approx(1).margin(0.15));
}

TEST_CASE("symplectic Euler is of first order with every treatment of damping", "[integrator]") {
  for (const auto treatment : {DampingTreatment::lagged, DampingTreatment::implicit, DampingTreatment::exact}) {
    CHECK(observed_order("symplectic-euler", treatment, 0.4, 1) == Approx(1).margin(0.15));
  }
}

TEST_CASE("adaptive methods of two libraries agree to their tolerance", "[integrator]") {
  const std::vector<double> exact = reference("gsl:rk8pd", 0.4);
  for (const Method& method : methods()) {
    if (!method.adaptive) continue;
    CAPTURE(method.name);
    const auto error = [&](double rtol) {
      return distance(
          state_at_end({.method = method.name, .max_step = end_time, .rtol = rtol, .atol_u = rtol, .atol_v = rtol},
                       0.4),
          exact);
    };
    CHECK(error(1e-7) < 1e-5);
    CHECK(error(1e-7) < 0.1 * error(1e-4));
  }
}

}  // namespace
