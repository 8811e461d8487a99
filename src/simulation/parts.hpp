// The parts of a simulation whose types are not installed: for the library's own studies, tests and Python module.
#pragma once

#include <stillpoint/simulation.hpp>

namespace stillpoint {

class LagrangianPhase;
struct Model;

struct SimulationParts {
  LagrangianPhase& phase;
  const Model& model;
  const Problem& problem;  // in its present stage
  bool is_readable;        // false if the points are between two phases, because the second could not begin
};

}  // namespace stillpoint
