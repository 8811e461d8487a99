#include "solvers/relaxation/relaxations.hpp"

#include <stillpoint/own_relaxation.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/registry.hpp"

namespace stillpoint {
namespace {

using Make = std::function<std::unique_ptr<Stepper>(const RelaxationOptions&, RelaxationSystem&)>;

Registry<RelaxationInfo, Make>& registry() {
  static Registry<RelaxationInfo, Make> all({
      {{.about = {.name = "kinetic",
                  .equation = "M a = Q, v = 0 at every peak of v'Mv/2",
                  .source = "Cundall 1976; Barnes 1999",
                  .keys = {"peak"},
                  .integrators = {"leapfrog", "erk:"},
                  .is_relaxation = true,
                  .resets_velocity = true,
                  .takes_inverse_mass = true},
        .is_event_of_erk = true},
       make_kinetic},
      {{.about = {.name = "adaptive",
                  .equation = "M a = Q - c M v, c = 2 sqrt(a Rayleigh quotient of the motion)",
                  .source = "Underwood 1983",
                  .keys = {"quotient"},
                  .integrators = {"leapfrog"},
                  .is_relaxation = true,
                  .takes_inverse_mass = true}},
       make_adaptive},
      {{.about = {.name = "papadrakakis",
                  .equation = "M a = Q - c M v, c = 2 omega_1, omega_1 from the decay |du_n+1|/|du_n|",
                  .source = "Papadrakakis 1981",
                  .integrators = {"leapfrog"},
                  .is_relaxation = true,
                  .takes_inverse_mass = true}},
       make_papadrakakis},
      {{.about = {.name = "fire",
                  .equation = "M a = Q, v turned towards Q; v = 0 if v.Q <= 0",
                  .source = "Bitzek, Koskinen, Gähler, Moseler, Gumbsch 2006",
                  .integrators = {"leapfrog"},
                  .is_relaxation = true,
                  .resets_velocity = true}},
       make_fire},
      {{.about = {.name = "fire2",
                  .equation = "the same, half a step back if v.Q <= 0",
                  .source = "Guénolé et al. 2020",
                  .integrators = {"leapfrog"},
                  .is_relaxation = true,
                  .resets_velocity = true}},
       make_fire2},
      {{.about = {.name = "chebyshev",
                  .equation = "v+ = beta_k v + gamma_k h Q/M, Chebyshev's polynomial on [omega_1^2, omega_max^2]",
                  .source = "Golub and Varga 1961",
                  .integrators = {"leapfrog"},
                  .is_relaxation = true,
                  .has_own_step = true,
                  .takes_inverse_mass = true},
        .needs_omega_1 = true,
        .step_fraction = 1,
        .needs_upper_end = true},
       make_chebyshev},
      {{.about = {.name = "nesterov",
                  .equation = "x+ = u + s Q/M, u+ = x+ + beta_k (x+ - x), begun again if Q.(x+ - x) < 0",
                  .source = "Nesterov 1983; O'Donoghue and Candès 2015",
                  .integrators = {"leapfrog"},
                  .is_relaxation = true,
                  .resets_velocity = true}},
       make_nesterov},
      {{.about = {.name = "auto",
                  .equation = "conjugate directions; elsewhere M a = Q - c M v, step, mass and c found by itself",
                  .source = "Hestenes and Stiefel 1952; Nocedal 1980; Underwood 1983",
                  .integrators = {"leapfrog"},
                  .is_relaxation = true,
                  .has_own_step = true,
                  .takes_inverse_mass = true},
        .chooses_mass = true,
        .step_fraction = 0.95},
       make_auto},
  });
  return all;
}

}  // namespace

const std::vector<RelaxationInfo>& relaxations() { return registry().infos(); }

void put_relaxation(const RelaxationInfo& info, MakeOwnRelaxation make) {
  registry().put(info, [make = std::move(make)](const RelaxationOptions& options, RelaxationSystem& system) {
    return make_own_relaxation(options, system, make);
  });
}

const RelaxationInfo* find_relaxation(std::string_view name) {
  const auto found = std::ranges::find(relaxations(), name, [](const RelaxationInfo& info) { return info.about.name; });
  return found == relaxations().end() ? nullptr : &*found;
}

std::unique_ptr<Stepper> make_relaxation(const RelaxationOptions& options, RelaxationSystem& system) {
  if (!(options.max_step > 0) || !std::isfinite(options.max_step)) {
    throw std::invalid_argument(fmt::format("a relaxation's max_step must be > 0, found {}", options.max_step));
  }
  if (const Make make = registry().maker(options.name)) return make(options, system);
  throw std::invalid_argument(fmt::format("there is no relaxation '{}'", options.name));
}

}  // namespace stillpoint
