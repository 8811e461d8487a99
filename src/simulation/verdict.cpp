#include "simulation/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "scene/own_loads.hpp"
#include "simulation/loads/formula_samples.hpp"
#include "system/largest_at.hpp"

namespace stillpoint {

std::string load_without_value(const Problem& problem, const LagrangianPhase& phase, double t, double step) {
  const auto dim = static_cast<std::size_t>(phase.dim());
  const std::array times{t, t + step / 2, t + step};
  const auto at_point = [&](std::size_t p) { return " at " + to_string(phase.diagnosis().of_point(p)); };
  const auto fault = [](const std::string& key, double value, double at) {
    return fmt::format("{} is {} at t = {:.6g}", key, std::isnan(value) ? "not a number" : "infinite", at);
  };
  std::string said;
  problem.for_each_formula([&](const std::string& key, const Expression& formula) {
    const bool somewhere = said.empty() && formula.uses_position();
    const std::vector<double> positions = somewhere ? formula_positions(problem, phase, key) : std::vector<double>();
    const std::size_t count = somewhere ? positions.size() / dim : 1;
    for (std::size_t p = 0; p < count && said.empty(); ++p) {
      const ConstVec x = somewhere ? ConstVec(positions).subspan(dim * p, dim) : ConstVec();
      for (const double at : times) {
        const double value = formula(x, at);
        if (std::isfinite(value) || !said.empty()) continue;
        said = fault(key, value, at);
        if (!x.empty())
          said += key.starts_with("body_force") ? at_point(p) : fmt::format(" at ({:.6g})", fmt::join(x, ", "));
      }
    }
  });
  const auto own = own_load(problem.own_load);
  if (!own || !said.empty()) return said;
  const std::vector<double> x = phase.fields().positions();
  std::vector<double> b(x.size());
  for (const double at : times) {
    own->b(at, problem.dim, x, b);
    const auto wrong = std::ranges::find_if_not(b, [](double value) { return std::isfinite(value); });
    if (wrong != b.end())
      return fault("body_force.own", *wrong, at) + at_point(static_cast<std::size_t>(wrong - b.begin()) / dim);
  }
  return "";
}

std::string most_stressed(const LagrangianPhase& phase, double t, ConstVec u) {
  const auto components = static_cast<std::size_t>(phase.info().stress_components);
  std::vector<double> stress(components * phase.points());
  phase.fields().point_stress(t, u, stress);
  const std::size_t largest = largest_entry(stress);
  return fmt::format("{} is stressed most, by {:.3g} Pa", to_string(phase.diagnosis().of_point(largest / components)),
                     std::abs(stress[largest]));
}

std::string furthest_from_rest(PhaseMotion& motion, double t) {
  const ConstVec v = motion.v();
  motion.residual(t);
  std::vector<double> Q(v.size());
  motion.system.last_out_of_balance(t, Q);
  const SemiDiscrete& system = motion.system.system();
  std::string said = "the out-of-balance force is largest at " + largest_at(system, Q);
  const double fastest = v.empty() ? 0 : std::abs(v[largest_entry(v)]);
  if (fastest > 0) said += fmt::format("; fastest, {:.3g} m/s, is {}", fastest, largest_at(system, v));
  return said;
}

}  // namespace stillpoint
