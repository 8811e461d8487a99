// External forces at the free degrees of freedom: what is constant is summed once, what depends on t each time.
#pragma once

#include <stillpoint/expression.hpp>
#include <stillpoint/types.hpp>

#include <utility>
#include <vector>

#include "base/parallel_loop.hpp"

namespace stillpoint {

/// F_i(t) = Σ_loads w_i value(t)
class NodalLoads {
 public:
  using Weights = std::vector<std::pair<int, double>>;  // (free degree of freedom, w_i)

  explicit NodalLoads(std::size_t n) : constant_(n, 0.0) {}

  void add(const Expression& value, Weights weights) {
    if (value.uses('t')) {
      varying_.push_back({value, std::move(weights)});
    } else {
      for (const auto& [dof, weight] : weights) constant_[static_cast<std::size_t>(dof)] += weight * value({}, 0);
    }
  }
  void add_constant(int dof, double force) { constant_[static_cast<std::size_t>(dof)] += force; }

  void evaluate(double t, Vec F) const {
    for_each_index(F.size(), [F, constant = constant_.data()](std::size_t i) { F[i] = constant[i]; });
    for (const auto& [value, weights] : varying_) {
      const double force = value({}, t);
      for (const auto& [dof, weight] : weights) F[static_cast<std::size_t>(dof)] += weight * force;
    }
  }

 private:
  struct Varying {
    Expression value;
    Weights weights;
  };
  std::vector<double> constant_;
  std::vector<Varying> varying_;
};

}  // namespace stillpoint
