// What the tests of integrators share: a chain whose force can be made to fail, with one integrator on it.
#pragma once

#include <stillpoint/integrator.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"

namespace stillpoint::test {

/// A chain whose force can be made to fail: `trouble` is asked before every evaluation.
class TroubledChain : public Chain {
 public:
  using Chain::Chain;
  std::function<bool(ConstVec u, Vec R)> trouble;  // true: R is set, or the trial refused, by trouble itself
  bool answer = true;                              // what internal_force then returns

  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
    if (trouble && trouble(u, R)) return answer;
    return Chain::internal_force(t, u, R, trial);
  }
};

/// A chain, its damping, its state and one integrator on it.
struct Setup {
  explicit Setup(const std::string& method, double h, std::optional<double> rtol = {},
                 ChainOptions chain_options = {.n = 3}, const std::string& strategy = "viscous", double c = 0.3,
                 DampingTreatment treatment = DampingTreatment::automatic)
      : chain(std::move(chain_options)),
        damping(make_damping(strategy, c, 0.5)),
        system(chain, *damping),
        values(2 * chain.size()),
        y(system.vectors().view(values)) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1 * std::sin(1.0 + static_cast<double>(i));
    IntegratorOptions options;
    options.method = method;
    options.treatment = treatment;
    options.max_step = h;
    options.rtol = rtol;
    options.atol_u = options.atol_v = 1e-6;
    integrator = make_integrator(options, system);
  }
  void start(double t = 0) { integrator->start(t, y); }

  TroubledChain chain;
  std::unique_ptr<Damping> damping;
  RelaxationSystem system;
  std::vector<double> values;
  Vector y;
  std::unique_ptr<Stepper> integrator;
};

/// Each method in each way that it can step.
inline void for_each_way(const std::function<void(const Method&, std::optional<double> rtol)>& test) {
  for (const Method& method : methods()) {
    CAPTURE(method.name);
    if (method.fixed_step) test(method, {});
    if (method.adaptive) test(method, 1e-4);
  }
}

}  // namespace stillpoint::test
