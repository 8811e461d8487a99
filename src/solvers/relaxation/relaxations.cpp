#include "solvers/relaxation/relaxations.hpp"

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace stillpoint {

std::unique_ptr<Integrator> make_strategy(const IntegratorOptions& options, RelaxationSystem& system) {
  using Make = std::unique_ptr<Integrator> (*)(const IntegratorOptions&, RelaxationSystem&);
  constexpr std::pair<std::string_view, Make> strategies[] = {
      {"kinetic", make_kinetic},
      {"adaptive", make_adaptive},
      {"papadrakakis", make_papadrakakis},
      {"fire", make_fire},
      {"fire2", make_fire2},
      {"chebyshev", make_chebyshev},
      {"nesterov", make_nesterov},
      {"cg", make_cg},
      {"lbfgs", make_lbfgs},
      {"auto", make_auto},
  };
  for (const auto& [name, make] : strategies) {
    if (name == system.damping().name()) return make(options, system);
  }
  throw std::logic_error("the strategy '" + std::string(system.damping().name()) + "' has no iteration");
}

}  // namespace stillpoint
