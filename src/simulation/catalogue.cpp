// A stand-in until the tables of each room hold rows of the catalogue themselves.
#include "simulation/catalogue.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>

#include "space/materials/material_laws.hpp"

namespace stillpoint {

const Catalogue& catalogue() {
  using enum DampingTreatment;
  static const Catalogue all = [] {
    Catalogue result;
    result.laws = material_laws();
    for (const DampingInfo& info : damping_strategies()) {
      if (info.is_static) {
        result.static_methods.push_back({info.name, info.equation, info.source});
        continue;
      }
      StrategyInfo row{.name = info.name, .equation = info.equation, .source = info.source};
      if (info.takes_c) row.keys.push_back("c");
      if (info.takes_alpha) row.keys.push_back("alpha");
      if (info.takes_peak) row.keys.push_back("peak");
      if (info.takes_quotient) row.keys.push_back("quotient");
      row.integrators = info.integrators;
      row.is_identity = info.name == "identity";
      row.is_relaxation = info.owns_iteration;
      row.has_own_step = info.has_own_step;
      row.resets_velocity = info.resets_velocity;
      result.strategies.push_back(row);
    }
    result.static_methods.insert(result.static_methods.begin(),
                                 {{"newton", "K(u) du = F - R(u)", "Newton's method", true},
                                  {"newton-cg", "the same by conjugate gradients", "Newton's method", true}});
    for (const Method& method : methods()) {
      MethodInfo row{method.name, method.description, method.fixed_step, method.adaptive};
      if (method.name == "leapfrog") row.treatments = {automatic, averaged, lagged};
      if (method.name == "symplectic-euler") row.treatments = {automatic, lagged, implicit, exact};
      result.methods.push_back(row);
    }
    return result;
  }();
  return all;
}

}  // namespace stillpoint
