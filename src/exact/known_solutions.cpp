#include "exact/known_solutions.hpp"

namespace stillpoint {

const std::vector<KnownSolution>& known_solutions() {
  static const std::vector<KnownSolution> rows = {column_solution(),      lame_cylinder_solution(), kirsch_solution(),
                                                  strip_load_solution(),  elastica_solution(),      vortex_solution(),
                                                  radial_mode_solution(), torsion_solution(),       flexure_solution()};
  return rows;
}

}  // namespace stillpoint
