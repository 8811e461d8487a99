#include "simulation/catalogue.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/relaxation.hpp>

#include "exact/known_solutions.hpp"
#include "solvers/statics/static_methods.hpp"
#include "space/materials/material_laws.hpp"

namespace stillpoint {

const Catalogue& catalogue() {
  static const Catalogue all = [] {
    Catalogue catalogue{.laws = material_laws(),
                        .strategies = dampings(),
                        .static_methods = static_methods(),
                        .methods = {},
                        .solutions = {}};
    for (const KnownSolution& known : known_solutions()) catalogue.solutions.push_back(known.about);
    for (const RelaxationInfo& relaxation : relaxations()) catalogue.strategies.push_back(relaxation.about);
    for (const Method& method : methods()) catalogue.methods.push_back(method);
    return catalogue;
  }();
  return all;
}

}  // namespace stillpoint
