// What the tests of relaxations share: chains, and a system on its way to rest.
#pragma once

#include <stillpoint/relaxation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "way_to_rest.hpp"

namespace stillpoint::test {

using Values = std::vector<double>;

inline const std::vector<std::string> iterations = {"kinetic",   "adaptive", "papadrakakis", "fire",  "fire2",
                                                    "chebyshev", "nesterov", "cg",           "lbfgs", "auto"};

/// A chain with a load of its own on each mass.
class LoadedChain final : public Chain {
 public:
  LoadedChain(ChainOptions options, Values loads) : Chain(std::move(options)), loads_(std::move(loads)) {}
  void external_force(double /*t*/, ConstVec /*u*/, Vec F) const override {
    std::copy(loads_.begin(), loads_.end(), F.begin());
  }

 private:
  Values loads_;
};

/// 156 equal masses held at both ends under a uniform load: κ = 9989.
inline ChainOptions long_chain() { return {.n = 156, .left_held = true, .right_held = true, .load = 1e-4}; }

/// u with R(u) = F, by Newton's method.
inline Values static_solution(const SemiDiscrete& system) {
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

/// The Chebyshev estimate for a linear system of condition number κ.
inline double lower_bound(double kappa, double accuracy) { return 0.5 * std::sqrt(kappa) * std::log(2 / accuracy); }

/// How a system goes to rest.
struct Way {
  std::string strategy;
  double step_fraction = 0.9;
  double c = 0, alpha = 0.2;
  RelaxationOptions options{};
  std::string method = "leapfrog";
};

/// A system on its way to rest from the state y = [u; v] on: if none is given, from u = v = 0.
struct Relaxing {
  Relaxing(SemiDiscrete& body, const Way& way, double max_step, Values from = {})
      : damping(damping_of(way.strategy, way.c, way.alpha)),
        system(body, *damping),
        y(from.empty() ? Values(2 * body.size()) : std::move(from)),
        state(system.vectors().view(y)) {
    IntegratorOptions stepping;
    stepping.method = way.method;
    stepping.max_step = max_step;
    stepper = stepper_of(way.strategy, stepping, system, way.options);
    stepper->start(0, state);
  }
  StepReport step() {
    const StepReport report = stepper->step(1e9);
    INFO(report.message);
    REQUIRE(report.status == StepReport::Status::ok);
    return report;
  }

  std::unique_ptr<Damping> damping;
  RelaxationSystem system;
  Values y;
  Vector state;
  std::unique_ptr<Stepper> stepper;
};

/// ‖u − u*‖/‖u*‖
inline double relative_distance(ConstVec u, const Values& solution) {
  double error = 0, scale = 0;
  for (std::size_t i = 0; i < solution.size(); ++i) {
    error += std::pow(u[i] - solution[i], 2);
    scale += std::pow(solution[i], 2);
  }
  return std::sqrt(error / scale);
}

/// Force evaluations until ‖u − u*‖ ≤ accuracy ‖u*‖, most + 1 if that does not come.
inline long evaluations_to(double accuracy, SemiDiscrete& system, const Values& solution, double omega_max,
                           const Way& way, long most = 100'000) {
  INFO(way.strategy);
  Relaxing relaxing(system, way, way.step_fraction * 2 / omega_max);
  while (relaxing.system.evaluations() <= most) {
    if (relative_distance(relaxing.y, solution) <= accuracy) return relaxing.system.evaluations();
    relaxing.step();
  }
  return most + 1;
}

inline long evaluations_of(const Chain& like, const Way& way, double accuracy = 1e-6) {
  Chain chain(like.options());
  return evaluations_to(accuracy, chain, static_solution(chain), chain.exact_omega(chain.size()), way);
}

}  // namespace stillpoint::test
