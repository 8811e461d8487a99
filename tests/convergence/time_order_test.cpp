// The observed order in time of every method on offer, with fixed steps, on two nonlinear systems under a load that
// depends on time (so that the nodes c count), undamped and damped. Reference: another library at a tight tolerance.
//
//   chain   u_i'' = T(u_{i+1} − u_i) − T(u_i − u_{i−1}) − c u_i' + ½ cos(3 t + i),   T(e) = e + ½ e³,  0 ≤ t ≤ 4
//   bar     the paper's bar, neo-Hookean, P0 = 0.05 cos 2t at its end, from a rough state in motion,  0 ≤ t ≤ 2
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace {

using namespace stillpoint;

class DrivenChain : public test::Chain {
 public:
  DrivenChain() : Chain({.n = 4, .cubic = 0.5}) {}
  void external_force(double t, ConstVec, Vec F) const override {
    for (std::size_t i = 0; i < F.size(); ++i) F[i] = 0.5 * std::cos(3 * t + static_cast<double>(i));
  }
};

struct Problem {
  std::string name;
  std::unique_ptr<SemiDiscrete> system;
  std::vector<double> start;  // [u; v]
  double end_time;
};

// A state that excites every mode, so that errors of high order stay above rounding.
std::vector<double> rough_state(std::size_t n) {
  std::vector<double> y(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    y[i] = 0.2 * std::sin(0.7 * (static_cast<double>(i) + 1));
    y[n + i] = 0.3 * std::cos(1.1 * static_cast<double>(i));
  }
  return y;
}

Problem driven_chain() { return {"chain", std::make_unique<DrivenChain>(), rough_state(4), 4}; }

Problem driven_bar() {
  auto phase = make_phase(scenes::bar({"material.bar.law=neo-hookean", "force=[{at=10.0, value='0.05*cos(2*t)'}]"}));
  std::vector<double> start = rough_state(phase->size());
  return {"bar", std::move(phase), std::move(start), 2};
}

std::vector<double> state_at_end(Problem& problem, const IntegratorOptions& options, double c) {
  const auto damping = make_damping("viscous", c, 0);
  RelaxationSystem system(*problem.system, *damping);
  std::vector<double> y = problem.start;
  Vector vector = system.vectors().view(y);
  const auto integrator = make_integrator(options, system);
  integrator->start(0, vector);
  StepReport report;
  while (report.t < problem.end_time) {
    report = integrator->step(problem.end_time);
    REQUIRE(report.status == StepReport::Status::ok);
  }
  return y;
}

std::vector<double> reference(Problem& problem, const std::string& method, double c) {
  return state_at_end(problem, {.method = method, .max_step = 0.1, .rtol = 1e-14, .atol_u = 1e-15, .atol_v = 1e-15}, c);
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squares);
}

// Where to begin looking for the asymptotic range of the error.
int first_steps(int order) {
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

// Below it the error of the reference shows.
constexpr double rounding = 2e-13;

// Errors of ever halved steps, the largest first, as long as they are above rounding; at most eight.
std::vector<double> errors_of_halved_steps(Problem& problem, const std::string& method, DampingTreatment treatment,
                                           double c, int order) {
  const std::vector<double> exact = reference(problem, method == "gsl:rk8pd" ? "erk:fehlberg-13-7-8" : "gsl:rk8pd", c);
  const auto error = [&](int steps) {
    IntegratorOptions options;
    options.method = method;
    options.treatment = treatment;
    options.max_step = problem.end_time / steps;
    return distance(state_at_end(problem, options, c), exact);
  };
  int steps = first_steps(order);
  std::vector<double> errors{error(steps)};
  while (steps > 4 && errors.front() < 1e6 * rounding) errors.front() = error(steps /= 2);
  while (errors.size() < 8) {
    const double next = error(steps *= 2), last = errors.back();
    // SUNDIALS 7 writes a table, verner-9-5-6, with fewer digits than a number has: its error ends at 1e-12.
    const bool at_rounding_of_table = last < 1e-11 && next > last * std::exp2(-order / 2.0);
    if (!(next >= rounding) || at_rounding_of_table) break;
    errors.push_back(next);
  }
  return errors;
}

// An observed order nears its limit like h, p(h) = p + O(h), so 2 p(h/2) − p(h) is nearer; order 8 leaves no room for
// it. Tables that were made to have a small leading term show the order of the next one until rounding hides both: they
// are at least as good as they say.
void check_order(Problem& problem, const std::string& method, DampingTreatment treatment, double c, int order) {
  const std::vector<double> errors = errors_of_halved_steps(problem, method, treatment, c, order);
  REQUIRE(errors.size() >= 3);
  std::vector<double> orders;
  for (std::size_t k = 1; k < errors.size(); ++k) orders.push_back(std::log2(errors[k - 1] / errors[k]));
  const double last = orders.back(), limit = order < 8 ? 2 * last - orders[orders.size() - 2] : last;
  const double mean = std::log2(errors.front() / errors.back()) / static_cast<double>(orders.size());
  CAPTURE(orders, limit, mean);
  const bool shows_it = std::abs(limit - order) < 0.15;
  CHECK((shows_it || (order >= 5 && mean > order - 0.15)));
}

TEST_CASE("every method shows its order in time, undamped and damped", "[integrator]") {
  for (const auto& make_problem : {driven_chain, driven_bar}) {
    Problem problem = make_problem();
    for (const Method& method : methods()) {
      if (!method.fixed_step) continue;
      for (const double c : {0.0, 0.4}) {
        CAPTURE(problem.name, method.name, c);
        check_order(problem, method.name, DampingTreatment::automatic, c, method.order);
      }
    }
  }
}

TEST_CASE("leapfrog with lagged damping is of second order undamped and of first order damped", "[integrator]") {
  Problem chain = driven_chain();
  check_order(chain, "leapfrog", DampingTreatment::lagged, 0, 2);
  check_order(chain, "leapfrog", DampingTreatment::lagged, 0.4, 1);
}

TEST_CASE("symplectic Euler is of first order with every treatment of damping", "[integrator]") {
  Problem chain = driven_chain();
  for (const auto treatment : {DampingTreatment::lagged, DampingTreatment::implicit, DampingTreatment::exact}) {
    check_order(chain, "symplectic-euler", treatment, 0.4, 1);
  }
}

TEST_CASE("adaptive methods of two libraries agree to their tolerance", "[integrator]") {
  Problem chain = driven_chain();
  const std::vector<double> exact = reference(chain, "gsl:rk8pd", 0.4);
  for (const Method& method : methods()) {
    if (!method.adaptive) continue;
    CAPTURE(method.name);
    const auto error = [&](double rtol) {
      return distance(
          state_at_end(
              chain, {.method = method.name, .max_step = chain.end_time, .rtol = rtol, .atol_u = rtol, .atol_v = rtol},
              0.4),
          exact);
    };
    CHECK(error(1e-7) < 1e-5);
    CHECK(error(1e-7) < 0.1 * error(1e-4));
  }
}

}  // namespace
